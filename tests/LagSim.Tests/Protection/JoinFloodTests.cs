using System;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// A hundred thousand joins a second, from spoofed addresses and from a hundred machines that are there: honest clients get in meanwhile.
/// </summary>
public sealed class JoinFloodTests(ITestOutputHelper output) : IDisposable
{
    private const int Machines = 100;
    private const int AMillisecond = 100;

    private readonly HostIdentity identity = HostIdentity.Draw();

    public void Dispose() => identity.Dispose();

    [Theory]
    [InlineData("connect requests", 0)]
    [InlineData("joins without a cookie", 0)]
    [InlineData("joins of machines that are there", Machines)]
    public void Join_DuringAFlood_TakesNoLonger(string kind, int machines)
    {
        CountingProtection protection = new(new SecureHost(identity));
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.PureDelay(10), expected: 0, options: _ => new HostOptions { Protection = protection });
        group.Run(1);
        Attacker[] attackers = [.. Enumerable.Range(0, Machines).Select(n => new Attacker(group, 500 + n))];
        foreach (Attacker attacker in attackers)
        {
            attacker.AskForACookie();
        }

        group.Run(0.2);
        protection.Reads = 0;
        Random random = new(1);
        ClientSession? honest = null;
        double began = 0, took = double.NaN;
        int seconds = machines > 0 ? 12 : 3; // longer than the bursts last
        for (int ms = 0; ms < 1000 * seconds; ms++)
        {
            for (int n = 0; n < AMillisecond; n++)
            {
                Attacker attacker = attackers[random.Next(Machines)];
                attacker.Send(random, kind);
            }

            group.Run(0.001);
            if (ms == 500)
            {
                honest = group.Join(1, 7, new ClientOptions { Protection = new SecureClient(identity.Fingerprint) });
                began = group.Clock.Now.ToSeconds();
            }

            if (honest?.State == SessionState.Running)
            {
                took = group.Clock.Now.ToSeconds() - began;
                began = double.MaxValue;
                break;
            }
        }

        output.WriteLine(FormattableString.Invariant($"{kind}: in after {took:0.00} s, {protection.Reads} handshakes read"));
        Assert.InRange(took, 0, 2);
        int most = (machines * new JoinLimits().HandshakeBurst) + (int)(machines * 3) + 1; // the burst, one a second from each, and the honest client's
        Assert.InRange(protection.Reads, 1, most);
        Assert.Equal(1, group.Host.ClientCount);
        Assert.All(attackers, attacker => Assert.True(attacker.BytesIn <= attacker.BytesOut));
    }

    /// <summary>The count sees what the limit holds back.</summary>
    [Fact]
    public void Handshakes_OfOneMachine_AreReadAsOftenAsItsLimitAllows()
    {
        foreach ((double perSecond, int burst, int most) in new[] { (1.0, 8, 12), (1e9, 1_000_000, int.MaxValue) })
        {
            CountingProtection protection = new(new SecureHost(identity));
            SessionGroup group = new(
                ScriptedActions.Box(), 1, LinkProfiles.PureDelay(10), expected: 0, options: _ => new HostOptions
                {
                    Protection = protection,
                    JoinLimits = new() { HandshakesPerSecond = perSecond, HandshakeBurst = burst },
                });
            group.Run(1);
            Attacker attacker = new(group, 500);
            attacker.AskForACookie();
            group.Run(0.2);
            Random random = new(2);
            for (int n = 0; n < 300; n++)
            {
                attacker.Send(random, "joins of machines that are there");
                group.Run(0.01);
            }

            Assert.True(most == int.MaxValue ? protection.Reads >= 299 : protection.Reads <= most, $"{protection.Reads} read");
        }
    }

    /// <summary>Thousands of machines, each within its own limit, have no more read than the limit of all allows.</summary>
    [Fact]
    public void Handshakes_OfThousandsOfMachines_AreReadAsOftenAsTheLimitOfAllAllows()
    {
        const int machines = 1000, each = 4;
        foreach ((double ofAll, int read) in new[] { (250, 250), (1e9, machines * each) })
        {
            CountingProtection protection = new(new SecureHost(identity));
            SessionGroup group = new(
                ScriptedActions.Box(), 1, LinkProfiles.PureDelay(10), expected: 0, options: _ => new HostOptions
                {
                    Protection = protection,
                    JoinLimits = new() { HandshakesPerSecondOfAll = ofAll },
                });
            group.Run(1);
            Attacker[] attackers = [.. Enumerable.Range(0, machines).Select(n => new Attacker(group, 500 + n))];
            Array.ForEach(attackers, attacker => attacker.AskForACookie());
            group.Run(0.2);
            Random random = new(3);
            for (int n = 0; n < each; n++)
            {
                Array.ForEach(attackers, attacker => attacker.Send(random, "joins of machines that are there"));
            }

            group.Run(0.2);
            Assert.Equal(read, protection.Reads);
        }
    }

    /// <summary>Sealed datagrams of no link are answered with the proof of a host, but not without end.</summary>
    [Fact]
    public void Resets_AskedForByAFlood_AreLimited()
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.PureDelay(10), expected: 0, options: _ => new HostOptions { Protection = new SecureHost(identity) });
        group.Run(1);
        Attacker attacker = new(group, 500);
        for (int n = 0; n < 3000; n++)
        {
            attacker.SendStray((ulong)n);
        }

        group.Run(0.1);
        Assert.Equal(1000, attacker.DatagramsIn);
    }

    private sealed class Attacker
    {
        private readonly IDatagramPort port;
        private readonly byte[] buffer = new byte[WireFormat.MaxBytes];
        private readonly byte[] join = new byte[WireFormat.SecureJoinBytes];
        private readonly ulong nonce;
        private Token128 cookie;

        internal Attacker(SessionGroup group, int node)
        {
            nonce = (ulong)node;
            port = group.Network.CreatePort(node);
            port.Arrived += () =>
            {
                while (port.TryReceive(buffer, out int length, out _))
                {
                    BytesIn += length;
                    DatagramsIn++;
                    cookie = ChallengeDatagram.TryDecode(buffer.AsSpan(0, length), out ChallengeDatagram challenge, out _) ? challenge.Cookie : cookie;
                }
            };
        }

        internal long BytesIn { get; private set; }

        internal long BytesOut { get; private set; }

        internal int DatagramsIn { get; private set; }

        internal void SendStray(ulong session)
        {
            byte[] bytes = new byte[80];
            WireWriter writer = new(bytes);
            writer.WriteHeader(DatagramType.Sealed);
            writer.WriteUInt64(session);
            writer.WriteUInt32(1); // the rest is a seal of nobody's
            Send(bytes);
        }

        internal void AskForACookie() => Send(AnyDatagramBytes(new ConnectRequestDatagram(nonce).Encode));

        internal void Send(Random random, string kind)
        {
            if (kind == "connect requests")
            {
                Send(AnyDatagramBytes(new ConnectRequestDatagram((ulong)random.NextInt64()).Encode));
                return;
            }

            random.NextBytes(join);
            bool isThere = kind != "joins without a cookie";
            JoinDatagram.WritePrologue(join, DatagramType.SecureJoin, isThere ? nonce : (ulong)random.NextInt64(), isThere ? cookie : default);
            Send(join);
        }

        private static byte[] AnyDatagramBytes(Wire.AnyDatagram.Encoder encode) => Wire.AnyDatagram.Bytes(encode);

        private void Send(byte[] bytes)
        {
            BytesOut += bytes.Length;
            port.Send(bytes, PeerAddress.Virtual(0));
        }
    }

    private sealed class CountingProtection(SecureHost host) : IHostProtection
    {
        internal int Reads { get; set; }

        public bool RequiresToken => host.RequiresToken;

        public int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination) => host.WriteIdentity(wanted, destination);

        public IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload)
        {
            Reads++;
            return host.TryRead(key, prologue, message, payload);
        }

        public TokenReading ReadToken(ReadOnlySpan<byte> token) => host.ReadToken(token);

        public bool TryUseToken(ReadOnlySpan<byte> token) => host.TryUseToken(token);

        public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key) => host.WriteResetKey(link, key);
    }
}
