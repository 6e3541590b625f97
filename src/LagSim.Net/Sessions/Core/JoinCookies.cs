using System;
using System.Buffers.Binary;
using System.Security.Cryptography;
using System.Text;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Lets a host verify, without keeping any state, that a joining client is at its claimed address and has the connect key.
/// </summary>
/// <remarks>
/// A cookie is HMAC-SHA-256 over address, nonce and half minute with a secret of this host; it is valid for half a minute to a minute. The
/// proof of a key is HMAC-SHA-256 over nonce, cookie and the host's identity with the key. Both are cut to 128 bits. A session id is
/// HMAC-SHA-256 with the secret too, so a client cannot derive another's from its own. For one thread.
/// </remarks>
internal sealed class JoinCookies : IDisposable
{
    private const int HashBytes = 32;
    private static readonly SimDuration Age = SimDuration.FromSeconds(30);

    private readonly HMACSHA256 maker;

    internal JoinCookies()
    {
        byte[] secret = new byte[HashBytes];
        RandomNumberGenerator.Fill(secret); // does not affect determinism: a cookie or session id is right or wrong whatever its bits
        maker = new HMACSHA256(secret);
    }

    public void Dispose() => maker.Dispose();

    /// <summary>Computes the proof that a client has the connect key.</summary>
    /// <param name="connectKey">The key.</param>
    /// <param name="nonce">The nonce of the join.</param>
    /// <param name="cookie">The cookie that it brings back.</param>
    /// <param name="host">The host that it is proved to; none in a session without protection.</param>
    internal static Token128 Prove(string connectKey, ulong nonce, Token128 cookie, in PublicIdentity host = default)
    {
        using HMACSHA256 prover = new(Encoding.UTF8.GetBytes(connectKey));
        return Prove(prover, nonce, cookie, host);
    }

    internal Token128 Make(PeerAddress address, ulong nonce, SimTime now) => Make(address, nonce, Epoch(now));

    internal bool IsGood(PeerAddress address, ulong nonce, Token128 cookie, SimTime now)
    {
        long epoch = Epoch(now);
        return cookie == Make(address, nonce, epoch) || cookie == Make(address, nonce, epoch - 1);
    }

    internal static bool IsProof(string key, in JoinDatagram join, in PublicIdentity host) =>
        join.Proof == Prove(key, join.Nonce, join.Cookie, host);

    /// <summary>Computes the proof that a client has a player's pass.</summary>
    internal static Token128 Prove(Token128 pass, ulong nonce, Token128 cookie, in PublicIdentity host = default)
    {
        byte[] key = new byte[Token128.Bytes];
        BinaryPrimitives.WriteUInt64LittleEndian(key, pass.First);
        BinaryPrimitives.WriteUInt64LittleEndian(key.AsSpan(sizeof(ulong)), pass.Second);
        using HMACSHA256 prover = new(key);
        return Prove(prover, nonce, cookie, host);
    }

    internal static bool IsProof(Token128 pass, in JoinDatagram join, in PublicIdentity host) =>
        join.PlayerProof == Prove(pass, join.Nonce, join.Cookie, host);

    /// <summary>The session id of the n-th join of a session.</summary>
    internal ulong SessionId(ulong session, ulong join)
    {
        Span<byte> bytes = stackalloc byte[2 * sizeof(ulong)];
        BinaryPrimitives.WriteUInt64LittleEndian(bytes, session);
        BinaryPrimitives.WriteUInt64LittleEndian(bytes.Slice(sizeof(ulong)), join);
        return Hash(maker, bytes).First;
    }

    private static long Epoch(SimTime now) => now.Ticks / Age.Ticks;

    private static Token128 Prove(HMACSHA256 prover, ulong nonce, Token128 cookie, in PublicIdentity host)
    {
        Span<byte> bytes = stackalloc byte[sizeof(ulong) + Token128.Bytes + IHostProtection.IdentityBytes];
        WireWriter writer = new(bytes);
        writer.WriteUInt64(nonce);
        cookie.Write(ref writer);
        if (!host.IsNone)
        {
            host.Write(ref writer); // so that what one host was shown is no proof to another
        }

        return Hash(prover, bytes.Slice(0, writer.Position));
    }

    private static Token128 Hash(HMACSHA256 hmac, ReadOnlySpan<byte> bytes)
    {
        Span<byte> hash = stackalloc byte[HashBytes];
        return hmac.TryComputeHash(bytes, hash, out _)
            ? new Token128(hash)
            : throw new InvalidOperationException($"SHA-256 gave more than {HashBytes} bytes.");
    }

    private Token128 Make(PeerAddress address, ulong nonce, long epoch)
    {
        Span<byte> bytes = stackalloc byte[PeerAddress.Bytes + (2 * sizeof(ulong))];
        address.Write(bytes);
        BinaryPrimitives.WriteUInt64LittleEndian(bytes.Slice(PeerAddress.Bytes), nonce);
        BinaryPrimitives.WriteInt64LittleEndian(bytes.Slice(PeerAddress.Bytes + sizeof(ulong)), epoch);
        return Hash(maker, bytes);
    }
}
