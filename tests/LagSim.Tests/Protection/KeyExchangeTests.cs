using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Protection;

/// <summary>
/// A link gets fresh keys while it lasts: unnoticed by players, of no use to who has stolen those before, and not to be stopped but by ending the
/// link.
/// </summary>
public sealed class KeyExchangeTests : IDisposable
{
    private const int GenerationAt = 17;
    private const int ExchangeLength = WireFormat.KeyExchangeBytes + WireFormat.SealBytes;

    private readonly HostIdentity identity = HostIdentity.Draw();
    private readonly PathAttacker attacker = new();

    public void Dispose() => identity.Dispose();

    /// <summary>Over an hour players act around each exchange, on links that lose, repeat and reorder: nothing is lost, late or interrupted.</summary>
    [Theory]
    [InlineData("loopback")]
    [InlineData("3g")]
    [InlineData("awful")]
    public void Session_OfAnHour_GetsFreshKeysUnnoticed(string link)
    {
        SessionGroup group = new(
            ScriptedActions.Box(), 3, LinkProfiles.All.Single(l => l.Name == link), wrap: attacker.Wrap, options: Options(new SecureHost(identity)));
        group.Connect();
        int interruptions = 0, acts = 0, heard = 0;
        group.Client(1).Interrupted += _ => interruptions++;
        group.Client(2).Interrupted += _ => interruptions++;
        double changed = 0;
        int generation = 0;
        for (double time = 0; time < 3700;)
        {
            bool isNear = time - changed > 840;
            double step = isNear ? 0.5 : 30;
            if (isNear)
            {
                group.Do(1 + (acts++ % 2), PlayerAction.Impulse(First, V(0, 0.1)));
            }

            group.Run(step);
            time += step;
            int now = attacker.Heard.Skip(heard).Where(h => h.From == 1 && h.Bytes[3] == PathAttacker.Sealed).Select(h => h.Bytes[GenerationAt]).LastOrDefault((byte)generation);
            heard = attacker.Heard.Count;
            (changed, generation) = now == generation ? (changed, generation) : (time, now);
        }

        Assert.True(group.Settle(acts));
        group.Run(5);
        foreach (int peer in new[] { 1, 2 })
        {
            Assert.Equal([0, 1, 2, 3, 4], Generations(peer));
        }

        Assert.Equal([0, 1, 2, 3, 4], Generations(0));
        Assert.Equal(0, interruptions);
        Assert.True(acts > 100);
        Assert.Null(group.Difference());
        Assert.NotNull(group.Difference(group.Alone(group.Accepted.Skip(1)))); // the control: a world that lacks one of their acts
        Assert.All(group.Sessions, s => Assert.Equal(
            (0L, 0L, 0L, 0L), (s.Counters.DatagramsForged, s.Counters.StatesDiffered, s.Counters.EventsLost, s.Counters.Renewals)));
        Assert.All(group.Sessions, s => Assert.True(s == group.Host || s.Counters.StatesAgreed > 3000));
    }

    /// <summary>
    /// A thief takes all that a host knows of a link, and records everything. What was said up to then it reads, what is said after the next
    /// exchange not. The control: keys that are only derived from those before, as Noise's REKEY does, give it all that is said from then on.
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Read_WithStolenKeysAfterTheNextExchange_OnlyWhereKeysAreDerivedAlone(bool isDerivedAlone)
    {
        Leaking host = new(new SecureHost(identity), isDerivedAlone);
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, wrap: attacker.Wrap, options: peer => peer == 0
            ? new HostOptions { Protection = host }
            : new ClientOptions { Protection = isDerivedAlone ? new DerivingClient(new SecureClient(identity.Fingerprint)) : new SecureClient(identity.Fingerprint) });
        group.Connect();
        group.Run(2 * 960);
        Assert.Equal([0, 1, 2], Generations(1));
        int[] said = [.. Enumerable.Range(0, 3).Select(generation => Said().Count(bytes => bytes[GenerationAt] == generation))], read = Read(host.Stolen[0]);
        Assert.All(said, count => Assert.True(count > 50));
        Assert.Equal(said[0], read[0]);
        Assert.Equal(isDerivedAlone ? said[1..] : [0, 0], read[1..]);

        // Who steals the fresh keys reads nothing of before, either way.
        int[] later = Read(host.Stolen[1]);
        Assert.Equal((0, said[1]), (later[0], later[1]));

        // What it can open with what it has, and with what it can compute from that and from each offer that it read.
        int[] Read(IDatagramCipher stolen)
        {
            int[] opened = new int[3];
            byte[] plain = new byte[WireFormat.MaxBytes], offered = [], answer = new byte[IDatagramCipher.ExchangeBytes];
            IDatagramCipher known = stolen;
            foreach (byte[] bytes in Said())
            {
                Assert.True(SealedDatagram.TryDecode(bytes, out SealedDatagram one, out _));
                bool isOpened = one.TryOpen(known, plain, out int length);
                if (!isOpened && offered.Length > 0)
                {
                    byte[] prologue = [.. bytes[4..12], .. offered[12..16]];
                    if (known.TryAnswerExchange(prologue, offered.AsSpan(16), answer) is IDatagramCipher made && one.TryOpen(made, plain, out length))
                    {
                        (known, isOpened, offered) = (made, true, []);
                    }
                }

                opened[bytes[GenerationAt]] += isOpened ? 1 : 0;
                offered = isOpened && plain[3] == (byte)DatagramType.KeyExchange ? plain[..length] : offered;
            }

            return opened;
        }

        IEnumerable<byte[]> Said() => attacker.Heard.Where(h => h.From == 1 && h.Bytes[3] == PathAttacker.Sealed).Select(h => h.Bytes);
    }

    /// <summary>
    /// Somebody on the path lets everything through but exchanges, which it tells by their length. After an hour the link is given up, as if it
    /// had let nothing through, and the player comes back over another with keys of its own.
    /// </summary>
    [Fact]
    public void Block_NothingButExchanges_EndsTheLinkAfterAnHourAndNoMore()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, wrap: attacker.Wrap, options: Options(new SecureHost(identity)));
        group.Connect();
        List<string> why = [];
        group.Client(1).Interrupted += why.Add;
        attacker.Drops = (_, bytes) => bytes[3] == PathAttacker.Sealed && bytes.Length == ExchangeLength;
        ulong session = PathAttacker.U64(attacker.Last(1, PathAttacker.Sealed), PathAttacker.SessionAt);
        group.Run(3590);
        Assert.Empty(why);
        Assert.Equal([0], Generations(1));
        group.Run(30);
        Assert.Equal(["The host agreed on no fresh keys for 3600 s."], why);
        Assert.Equal((SessionState.Running, 1), (group.Client(1).State, group.Host.ClientCount));
        Assert.NotEqual(session, PathAttacker.U64(attacker.Last(1, PathAttacker.Sealed), PathAttacker.SessionAt));
        Assert.Equal((1, 1L), (group.Sessions[1].Peer, group.Client(1).Counters.Renewals));
        group.Run(3500);
        Assert.Single(why);
        Assert.Equal(0, group.Client(1).Counters.StatesDiffered);
    }

    /// <summary>Nobody but the link's other end has it exchange its keys: not in clear text, and not by what was heard before.</summary>
    [Fact]
    public void Force_AnExchangeFromThePath_HasNoEffect()
    {
        SessionGroup group = new(ScriptedActions.Box(), 2, LinkProfiles.Loopback, wrap: attacker.Wrap, options: Options(new SecureHost(identity)));
        group.Connect();
        group.Run(920);
        byte[][] exchanged = [.. attacker.Heard.Where(h => h.Bytes.Length == ExchangeLength).Select(h => h.Bytes)];
        Assert.Equal(2, exchanged.Length);
        ulong session = PathAttacker.U64(exchanged[0], PathAttacker.SessionAt);
        for (uint generation = 1; generation < 5; generation++)
        {
            byte[] message = new byte[IDatagramCipher.ExchangeBytes], bytes = new byte[WireFormat.KeyExchangeBytes];
            new Random((int)generation).NextBytes(message);
            foreach ((DatagramType type, int to) in new[] { (DatagramType.KeyExchange, 0), (DatagramType.KeyExchangeReply, 1) })
            {
                new KeyExchangeDatagram(session, generation, message).Encode(type, bytes);
                attacker.Send(1 - to, to, [.. bytes]);
            }

            attacker.Send(1, 0, exchanged[0]);
            attacker.Send(0, 1, exchanged[1]);
        }

        group.Run(120);
        Assert.Equal((4L, 4L), (group.Host.Counters.DatagramsForged, group.Client(1).Counters.DatagramsForged));
        Assert.Equal([0, 1], Generations(1));
        Assert.Equal(2, attacker.Heard.Count(h => h.Bytes.Length == ExchangeLength));
        Assert.Equal((SessionState.Running, 0L), (group.Client(1).State, group.Client(1).Counters.Renewals));
    }

    private static Func<int, SessionOptions> Options(SecureHost host) => peer => peer == 0
        ? new HostOptions { Protection = host }
        : new ClientOptions { Protection = new SecureClient(host.Identity.Fingerprint) };

    /// <summary>The generations of what a peer sealed, in the order in which they came.</summary>
    private int[] Generations(int peer) =>
        [.. attacker.Heard.Where(h => h.From == peer && h.Bytes[3] == PathAttacker.Sealed).Select(h => (int)h.Bytes[GenerationAt]).Distinct()];

    /// <summary>A host from which the ciphers of its links are stolen as they come: the thief's are never wiped.</summary>
    private sealed class Leaking(SecureHost real, bool isDerivedAlone) : IHostProtection
    {
        internal List<IDatagramCipher> Stolen { get; } = [];

        public bool RequiresToken => real.RequiresToken;

        public IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload) =>
            real.TryRead(key, prologue, message, payload) is IHostHandshake read ? new Handshake(read, this, isDerivedAlone) : null;

        public TokenReading ReadToken(ReadOnlySpan<byte> token) => real.ReadToken(token);

        public bool TryUseToken(ReadOnlySpan<byte> token) => real.TryUseToken(token);

        public int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination) => real.WriteIdentity(wanted, destination);

        public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key) => real.WriteResetKey(link, key);

        private sealed class Handshake(IHostHandshake read, Leaking thief, bool isDerivedAlone) : IHostHandshake
        {
            public void WriteBinding(Span<byte> destination) => read.WriteBinding(destination);

            public IDatagramCipher Accept(string connectKey, ReadOnlySpan<byte> payload, Span<byte> message)
            {
                IDatagramCipher cipher = read.Accept(connectKey, payload, message);
                byte[] shared = new byte[IHostProtection.BindingBytes];
                read.WriteBinding(shared);
                return new Stealing(isDerivedAlone ? Deriving.Of(shared, isHost: true) : cipher, thief);
            }

            public void Refuse(ReadOnlySpan<byte> payload, Span<byte> message) => read.Refuse(payload, message);

            public void Dispose() => read.Dispose();
        }

        private sealed class Stealing : IDatagramCipher
        {
            private readonly IDatagramCipher real;
            private readonly Leaking thief;

            internal Stealing(IDatagramCipher real, Leaking thief)
            {
                (this.real, this.thief) = (real, thief);
                thief.Stolen.Add(real);
            }

            public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination) =>
                real.Seal(number, associated, plain, destination);

            public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain) =>
                real.TryOpen(number, associated, source, plain);

            public IKeyExchange BeginExchange(ReadOnlySpan<byte> prologue, Span<byte> message) => real.BeginExchange(prologue, message);

            public IDatagramCipher? TryAnswerExchange(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> answer) =>
                real.TryAnswerExchange(prologue, message, answer) is IDatagramCipher fresh ? new Stealing(fresh, thief) : null;

            public void Dispose()
            {
            }
        }
    }

    private sealed class DerivingClient(SecureClient real) : IClientProtection
    {
        public bool KnowsHost => real.KnowsHost;

        public void WriteWanted(Span<byte> destination) => real.WriteWanted(destination);

        public IClientHandshake? Begin(ReadOnlySpan<byte> identity, ReadOnlySpan<byte> prologue) =>
            real.Begin(identity, prologue) is IClientHandshake begun ? new Handshake(begun) : null;

        private sealed class Handshake(IClientHandshake begun) : IClientHandshake
        {
            public bool IsHostKeyChanged => begun.IsHostKeyChanged;

            public void WriteBinding(Span<byte> destination) => begun.WriteBinding(destination);

            public void Write(ReadOnlySpan<byte> payload, Span<byte> message) => begun.Write(payload, message);

            public IDatagramCipher? TryFinish(string connectKey, ReadOnlySpan<byte> message, Span<byte> payload)
            {
                byte[] shared = new byte[IHostProtection.BindingBytes];
                begun.WriteBinding(shared);
                return begun.TryFinish(connectKey, message, payload) is null ? null : Deriving.Of(shared, isHost: false);
            }

            public bool TryReadRefusal(ReadOnlySpan<byte> message, Span<byte> payload) => begun.TryReadRefusal(message, payload);

            public void Dispose() => begun.Dispose();
        }
    }

    /// <summary>Keys of which each is made from the one before by Noise's REKEY, and by nothing else.</summary>
    private sealed class Deriving(byte[] sending, byte[] receiving) : IDatagramCipher
    {
        internal static Deriving Of(byte[] shared, bool isHost)
        {
            byte[] toHost = After(shared), toClient = After(toHost);
            return isHost ? new Deriving(toClient, toHost) : new Deriving(toHost, toClient);
        }

        public void Seal(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> plain, Span<byte> destination)
        {
            using Aead cipher = new BouncyCastleAead(sending);
            cipher.Seal(number, associated, plain, destination);
        }

        public bool TryOpen(ulong number, ReadOnlySpan<byte> associated, ReadOnlySpan<byte> source, Span<byte> plain)
        {
            using Aead cipher = new BouncyCastleAead(receiving);
            return cipher.TryOpen(number, associated, source, plain);
        }

        public IKeyExchange BeginExchange(ReadOnlySpan<byte> prologue, Span<byte> message) => new Done(Next());

        public IDatagramCipher TryAnswerExchange(ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> answer) => Next();

        public void Dispose()
        {
        }

        private static byte[] After(byte[] key)
        {
            byte[] after = new byte[48];
            using Aead cipher = new BouncyCastleAead(key);
            cipher.Seal(ulong.MaxValue, default, new byte[32], after);
            return after[..32];
        }

        private Deriving Next() => new(After(sending), After(receiving));

        private sealed class Done(IDatagramCipher next) : IKeyExchange
        {
            public IDatagramCipher TryFinish(ReadOnlySpan<byte> answer) => next;

            public void Dispose()
            {
            }
        }
    }
}
