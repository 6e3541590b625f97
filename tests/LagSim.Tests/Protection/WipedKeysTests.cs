using System;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// What holds keys in managed memory has none left when it is done with them: compared word by word with what it held. The control of each: without
/// wiping they are found.
/// </summary>
public sealed class WipedKeysTests
{
    private const ulong Session = 7;

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Cipher_OfBouncyCastle_KeepsNothing(bool isWiped)
    {
        string[] left = Left(words =>
        {
            BouncyCastleAead cipher = new(Drawn(32));
            cipher.Seal(1, Drawn(18), Drawn(200), new byte[216]);
            words.Note(cipher, "cipher");
            Wipe(cipher, isWiped);
        });
        Check(left, isWiped, "cipher.stream.engineState", "cipher.mac.r1", "cipher.block");
    }

    /// <summary>A join: the client's and the host's end of the handshake, with all that they held while it went on.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Handshake_OnceDone_KeepsNothing(bool isWiped)
    {
        string[] left = Left(words =>
        {
            using HostIdentity identity = HostIdentity.Draw();
            byte[] shown = new byte[IHostProtection.IdentityBytes], join = new byte[48 + 5], answer = new byte[64 + 3], said = new byte[3];
            SecureHost host = new(identity);
            host.WriteIdentity(new byte[16], shown);
            IClientHandshake client = new SecureClient(identity.Fingerprint).Begin(shown, [1])!;
            words.Note(client, "client");
            client.Write(Drawn(5), join);
            IHostHandshake its = host.TryRead(0, [1], join, new byte[5])!;
            IDatagramCipher atHost = its.Accept("key", Drawn(3), answer), atClient = client.TryFinish("key", answer, said)!;
            words.Note(its, "host");
            words.Note(atHost, "cipher at host");
            words.Note(atClient, "cipher at client");
            Wipe(client, isWiped);
            Wipe(its, isWiped);
            Wipe(atHost, isWiped);
            Wipe(atClient, isWiped);
        });
        Check(left, isWiped, "client.state.ck", "client.own.privateKey", "host.<state>P.ck", "cipher at host.chain", "cipher at client.chain");
    }

    /// <summary>
    /// A link exchanges its keys: what both ends held of the former ones, of the exchange and of the ones to come is gone a little after the
    /// other end has begun to use the fresh ones, and of these once the link ends.
    /// </summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Keys_OnceTheNextAreInUseAndTheLinkIsOver_AreGone(bool isWiped)
    {
        string[] left = Left(words =>
        {
            (LinkSeal client, LinkSeal host) = Ends();
            SimTime now = SimTime.FromSeconds(3);
            for (int n = 1; n <= 3; n++)
            {
                Assert.True(Pass(client, host) && Pass(host, client));
                Tend();
                now += LinkKeys.Interval;
                Assert.True(client.Keys.TryOffer(Session, now, out KeyExchangeDatagram offer));
                Note(words, client, $"client offers {n}");
                Assert.True(host.Keys.TryAnswer(offer, now, out KeyExchangeDatagram reply));
                Note(words, host, $"host answers {n}");
                Assert.True(client.Keys.TryFinish(reply));
                Note(words, client, $"client has {n}");
                Assert.True(Pass(client, host) && Pass(host, client));
                Tend();
                now += LinkKeys.Overtaken + SimDuration.OneTick;
                if (isWiped)
                {
                    Tend();
                    Assert.False(client.Keys.HasFormer || host.Keys.HasFormer);
                }
            }

            Wipe(client, isWiped);
            Wipe(host, isWiped);

            void Tend()
            {
                client.Keys.Tend(now);
                host.Keys.Tend(now);
            }
        });
        Check(left, isWiped, "client has 2.current.chain", "host answers 2.next.chain", "client has 3.current.chain", "host answers 3.next.chain");
    }

    /// <summary>Keys that are wiped are zeros, which everybody knows: nothing is exchanged with them any more.</summary>
    [Fact]
    public void Exchange_WithWipedKeys_IsNone()
    {
        (LinkSeal client, LinkSeal host) = Ends();
        SimTime now = SimTime.FromSeconds(3);
        Assert.True(Pass(client, host) && Pass(host, client));
        client.Keys.Tend(now);
        host.Keys.Tend(now);
        now += LinkKeys.Interval;
        Assert.True(client.Keys.TryOffer(Session, now, out KeyExchangeDatagram offer));
        host.Dispose();
        Assert.False(host.Keys.TryAnswer(offer, now, out _));
        client.Dispose();
        Assert.False(client.Keys.TryOffer(Session, now + LinkKeys.Again, out _));
        (NoiseCipher one, NoiseCipher other) = Ciphers();
        one.Dispose();
        Assert.Throws<ObjectDisposedException>(() => one.BeginExchange([1], new byte[48]));
        Assert.Throws<ObjectDisposedException>(() => one.TryAnswerExchange([1], new byte[48], new byte[48]));
        using IKeyExchange begun = other.BeginExchange([1], new byte[48]); // the control
    }

    /// <summary>What is left of two runs with keys of their own, but for what is public.</summary>
    private static string[] Left(Action<SecretWords> run)
    {
        SecretWords one = new(), other = new();
        run(other);
        run(one);
        string[] open = ["publicKey", "binding", "offer", "answer", "clientKey", "newest", "before", "tag", "currentBlock"]; // the last three: what is sent in clear text or encrypted, and its tag
        return one.Left(other, path => Array.Exists(open, name => path.EndsWith(name, StringComparison.Ordinal) || path.Contains($"<{name}>", StringComparison.Ordinal)));
    }

    private static void Check(string[] left, bool isWiped, params string[] keys)
    {
        Assert.True(!isWiped || left.Length == 0, string.Join(", ", left));
        Assert.All(keys, key => Assert.Equal(!isWiped, Array.IndexOf(left, key) >= 0));
    }

    /// <summary>Notes the keys that a link's end has besides those that were noted.</summary>
    private static void Note(SecretWords words, LinkSeal end, string name)
    {
        foreach (string field in new[] { "current", "next", "begun" })
        {
            words.Note(typeof(LinkKeys).GetField(field, System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic)!.GetValue(end.Keys), $"{name}.{field}");
        }
    }

    private static byte[] Drawn(int length) => System.Security.Cryptography.RandomNumberGenerator.GetBytes(length);

    private static void Wipe(IDisposable holder, bool isWiped)
    {
        if (isWiped)
        {
            holder.Dispose();
        }
    }

    private static (NoiseCipher Client, NoiseCipher Host) Ciphers()
    {
        using NoiseSymmetricState state = NoiseHandshake.Begin(Drawn(8), new byte[32]);
        return (NoiseCipher.OfClient(state), NoiseCipher.OfHost(state));
    }

    private static (LinkSeal Client, LinkSeal Host) Ends()
    {
        (NoiseCipher client, NoiseCipher host) = Ciphers();
        return (new LinkSeal(client), new LinkSeal(host));
    }

    /// <summary>Sends a datagram over the link; whether it was opened.</summary>
    private static bool Pass(LinkSeal from, LinkSeal to)
    {
        byte[] gone = new byte[WireFormat.LeaveBytes], sealing = new byte[WireFormat.MaxBytes];
        new LeaveDatagram(Session, 1, LeaveReason.Left).Encode(gone);
        int length = from.Seal(gone, sealing);
        return SealedDatagram.TryDecode(sealing.AsSpan(0, length), out SealedDatagram one, out _) && to.TryOpen(one, new byte[WireFormat.MaxBytes], out _, out _);
    }
}
