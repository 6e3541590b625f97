using System;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Testing.Links;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Protection;

/// <summary>
/// Somebody on the path who has stolen a host's identity reads the joins of its clients; what they prove in them is of no use to the thief.
/// </summary>
public sealed class StolenIdentityTests : IDisposable
{
    private static readonly DateTimeOffset Noon = new(2026, 11, 27, 12, 0, 0, TimeSpan.Zero);

    private readonly HostIdentity identity = HostIdentity.Draw(); // the thief has it too
    private readonly TokenIssuer issuer = TokenIssuer.Draw();
    private readonly PathAttacker attacker = new();

    public void Dispose()
    {
        identity.Dispose();
        issuer.Dispose();
    }

    /// <summary>
    /// A player comes back by its pass. The thief reads the join, lets it not pass, and shows the true host the same proofs in a handshake of
    /// its own. The control: proofs that cover the host's public key alone, as they once did, give it the player's place.
    /// </summary>
    [Theory]
    [InlineData(false, false)]
    [InlineData(true, true)]
    public void Take_APlayersPlace_OnlyWhereProofsCoverTheHostAlone(bool isHostAlone, bool isTaken)
    {
        SecureHost protection = new(identity, issuer.Key, () => Noon);
        SessionGroup group = new(
            ScriptedActions.Box(), 1, LinkProfiles.Loopback, expected: 0, wrap: attacker.Wrap,
            options: _ => new HostOptions { Protection = isHostAlone ? new HostAlone(protection) : protection });
        group.IsTapped = false;
        group.Run(1);
        ClientSession ada = group.Join(1, 7, new ClientOptions
        {
            Protection = Client(isHostAlone),
            Token = issuer.Issue(new PlayerAdmission("account 4711", "Ada"), identity.Fingerprint, now: Noon),
        });
        Assert.True(group.RunUntil(() => ada.State == SessionState.Running, 3), ada.EndReason);

        IClientHandshake? thief = null;
        attacker.Drops = (from, bytes) =>
        {
            if (from == 2 && bytes[3] == PathAttacker.SecureJoin && thief is null)
            {
                thief = JoinWithTheProofsOf(bytes);
            }

            return from == 2 && bytes[3] == PathAttacker.SecureJoin;
        };
        group.Join(2, 99, new ClientOptions { Protection = Client(isHostAlone), Pass = ada.Pass!.Value });
        group.Run(0.2);
        byte[] terms = new byte[WireFormat.SecureWelcomePayloadBytes];
        using IDatagramCipher? cipher = attacker.HasHeard(0, PathAttacker.SecureWelcome)
            ? thief!.TryFinish("", attacker.Last(0, PathAttacker.SecureWelcome)[12..], terms) : null;
        if (cipher is not null)
        {
            byte[] ready = PathAttacker.Empty([0, 0, 0, 0, .. terms[..8]], 0, 1), sealing = new byte[WireFormat.MaxBytes];
            ready[PathAttacker.FlagsAt] = 2;
            attacker.Send(2, 0, sealing[..SealedDatagram.Encode(ready, 1, cipher, sealing)]);
            group.Run(0.2);
        }

        Assert.Equal(isTaken, cipher is not null);
        Assert.Equal(PeerAddress.Virtual(isTaken ? 2 : 1), group.Host.Links.Single(link => link.Peer == ada.Peer).Address);
        Assert.Equal(isTaken ? SessionState.Ended : SessionState.Running, ada.State);
        thief!.Dispose();

        IClientHandshake JoinWithTheProofsOf(byte[] heard)
        {
            byte[] claims = new byte[heard.Length - 28 - 48], shown = new byte[IHostProtection.IdentityBytes], forged = [.. heard];
            using IHostHandshake? read = new SecureHost(identity).TryRead(0, heard.AsSpan(0, 28), heard.AsSpan(28), claims);
            Assert.NotNull(read); // the join is encrypted to the stolen key
            new SecureHost(identity).WriteIdentity(new byte[16], shown);
            IClientHandshake own = new SecureClient(identity.Fingerprint).Begin(shown, heard.AsSpan(0, 28))!;
            own.Write(claims, forged.AsSpan(28));
            attacker.Send(2, 0, forged);
            return own;
        }
    }

    /// <summary>What was shown of a connect key or a pass in one handshake is no proof in another, though nonce and cookie be the same.</summary>
    [Fact]
    public void Proof_OfOneHandshake_IsNoneInAnother()
    {
        byte[] shown = new byte[IHostProtection.IdentityBytes], one = new byte[IHostProtection.BindingBytes], other = new byte[IHostProtection.BindingBytes];
        new SecureHost(identity).WriteIdentity(new byte[16], shown);
        using IClientHandshake first = new SecureClient(identity.Fingerprint).Begin(shown, [1])!, second = new SecureClient(identity.Fingerprint).Begin(shown, [1])!;
        first.WriteBinding(one);
        second.WriteBinding(other);
        Token128 cookie = new(1, 2), pass = new(3, 4);
        JoinDatagram join = new(7, cookie, JoinCookies.Prove("key", 7, cookie, one), 0, 1, 1, JoinCookies.Prove(pass, 7, cookie, one));
        Assert.True(JoinCookies.IsProof("key", join, one) && JoinCookies.IsProof(pass, join, one));
        Assert.False(JoinCookies.IsProof("key", join, other) || JoinCookies.IsProof(pass, join, other));
        Assert.False(JoinCookies.IsProof("key", join, default) || JoinCookies.IsProof(pass, join, default));
    }

    /// <summary>
    /// Host and client see the same binding, and it is the page's: Noise's hash after the tokens e and es, computed here by hand from what
    /// was sent.
    /// </summary>
    [Fact]
    public void Binding_ByHand_IsTheHashOfNameKeyPrologueAndTheClientsKey()
    {
        byte[] shown = new byte[IHostProtection.IdentityBytes], prologue = [1, 2, 3], message = new byte[48], mine = new byte[32], its = new byte[32];
        SecureHost host = new(identity);
        host.WriteIdentity(new byte[16], shown);
        using IClientHandshake client = new SecureClient(identity.Fingerprint).Begin(shown, prologue)!;
        client.WriteBinding(mine);
        client.Write([], message);
        client.WriteBinding(its);
        Assert.Equal(mine, its); // also after the message
        using IHostHandshake read = host.TryRead(0, prologue, message, [])!;
        read.WriteBinding(its);
        byte[] h = Hash("Noise_NKpsk2_25519_ChaChaPoly_SHA256"u8.ToArray());
        h = Hash([.. h, .. prologue]);
        h = Hash([.. h, .. shown]);
        h = Hash([.. h, .. message[..32]]);
        Assert.Equal(h, mine);
        Assert.Equal(h, its);

        static byte[] Hash(byte[] bytes) => System.Security.Cryptography.SHA256.HashData(bytes);
    }

    private IClientProtection Client(bool isHostAlone) =>
        isHostAlone ? new HostAloneClient(new SecureClient(identity.Fingerprint)) : new SecureClient(identity.Fingerprint);

    /// <summary>The protection as it was: what proofs cover of a handshake is the host's public key, which is the same in all.</summary>
    private sealed class HostAlone(SecureHost real) : IHostProtection
    {
        public bool RequiresToken => real.RequiresToken;

        public IHostHandshake? TryRead(int key, ReadOnlySpan<byte> prologue, ReadOnlySpan<byte> message, Span<byte> payload) =>
            real.TryRead(key, prologue, message, payload) is IHostHandshake read ? new Handshake(read, real) : null;

        public TokenReading ReadToken(ReadOnlySpan<byte> token) => real.ReadToken(token);

        public bool TryUseToken(ReadOnlySpan<byte> token) => real.TryUseToken(token);

        public int WriteIdentity(ReadOnlySpan<byte> wanted, Span<byte> destination) => real.WriteIdentity(wanted, destination);

        public void WriteResetKey(ReadOnlySpan<byte> link, Span<byte> key) => real.WriteResetKey(link, key);

        private sealed class Handshake(IHostHandshake read, SecureHost host) : IHostHandshake
        {
            public void WriteBinding(Span<byte> destination) => host.WriteIdentity(new byte[16], destination);

            public IDatagramCipher Accept(string connectKey, ReadOnlySpan<byte> payload, Span<byte> message) => read.Accept(connectKey, payload, message);

            public void Refuse(ReadOnlySpan<byte> payload, Span<byte> message) => read.Refuse(payload, message);

            public void Dispose() => read.Dispose();
        }
    }

    private sealed class HostAloneClient(SecureClient real) : IClientProtection
    {
        public bool KnowsHost => real.KnowsHost;

        public void WriteWanted(Span<byte> destination) => real.WriteWanted(destination);

        public IClientHandshake? Begin(ReadOnlySpan<byte> identity, ReadOnlySpan<byte> prologue) =>
            real.Begin(identity, prologue) is IClientHandshake begun ? new Handshake(begun, identity.ToArray()) : null;

        private sealed class Handshake(IClientHandshake begun, byte[] identity) : IClientHandshake
        {
            public bool IsHostKeyChanged => begun.IsHostKeyChanged;

            public void WriteBinding(Span<byte> destination) => identity.CopyTo(destination);

            public void Write(ReadOnlySpan<byte> payload, Span<byte> message) => begun.Write(payload, message);

            public IDatagramCipher? TryFinish(string connectKey, ReadOnlySpan<byte> message, Span<byte> payload) =>
                begun.TryFinish(connectKey, message, payload);

            public bool TryReadRefusal(ReadOnlySpan<byte> message, Span<byte> payload) => begun.TryReadRefusal(message, payload);

            public void Dispose() => begun.Dispose();
        }
    }
}
