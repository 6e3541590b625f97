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
/// A cookie is HMAC-SHA-256 over address, nonce, half minute, and which key the host showed, with a secret of this host; it is valid for half
/// a minute to a minute. Its first three bits say which key that was, so that a host with several tries no other for a join. The
/// proof of a key or a pass is HMAC-SHA-256 over nonce, cookie and what the handshake alone has, with the key or the pass. Both are cut to
/// 128 bits. A session id is HMAC-SHA-256 with the secret too, so a client cannot derive another's from its own. Each use begins with a
/// label of its own, so that what a secret made for one is nothing for another. For one thread.
/// </remarks>
internal sealed class JoinCookies : IDisposable
{
    private const int HashBytes = 32;
    private const ulong KeyBits = IHostProtection.MaxKeys - 1;
    private static readonly SimDuration Age = SimDuration.FromSeconds(30);

    private readonly HMACSHA256 maker;

    private static ReadOnlySpan<byte> CookieLabel => "LagSim cookie"u8;

    private static ReadOnlySpan<byte> SessionLabel => "LagSim session id"u8;

    private static ReadOnlySpan<byte> KeyLabel => "LagSim key proof"u8;

    private static ReadOnlySpan<byte> PassLabel => "LagSim pass proof"u8;

    internal JoinCookies()
    {
        byte[] secret = new byte[HashBytes];
        RandomNumberGenerator.Fill(secret); // does not affect determinism: a cookie or session id is right or wrong whatever its bits
        maker = new HMACSHA256(secret); // which copies it, and wipes the copy when it is disposed
        CryptographicOperations.ZeroMemory(secret);
    }

    public void Dispose() => maker.Dispose();

    /// <summary>Computes the proof that a client has the connect key.</summary>
    /// <param name="connectKey">The key.</param>
    /// <param name="nonce">The nonce of the join.</param>
    /// <param name="cookie">The cookie that it brings back.</param>
    /// <param name="binding">What the handshake alone has; empty in a session without protection.</param>
    internal static Token128 Prove(string connectKey, ulong nonce, Token128 cookie, ReadOnlySpan<byte> binding = default)
    {
        byte[] key = Encoding.UTF8.GetBytes(connectKey);
        using HMACSHA256 prover = new(key);
        CryptographicOperations.ZeroMemory(key);
        return Prove(prover, KeyLabel, nonce, cookie, binding);
    }

    /// <summary>Makes a cookie.</summary>
    /// <param name="address">Where it is sent.</param>
    /// <param name="nonce">What it is for.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="key">Which of its keys the host shows with it, below <see cref="IHostProtection.MaxKeys"/>.</param>
    internal Token128 Make(PeerAddress address, ulong nonce, SimTime now, int key = 0) => Make(address, nonce, Epoch(now), key);

    /// <summary>Which key the host showed with a cookie.</summary>
    internal static int KeyOf(Token128 cookie) => (int)(cookie.First & KeyBits);

    internal bool IsGood(PeerAddress address, ulong nonce, Token128 cookie, SimTime now)
    {
        long epoch = Epoch(now);
        int key = KeyOf(cookie);
        return cookie == Make(address, nonce, epoch, key) || cookie == Make(address, nonce, epoch - 1, key);
    }

    internal static bool IsProof(string key, in JoinDatagram join, ReadOnlySpan<byte> binding) =>
        join.Proof == Prove(key, join.Nonce, join.Cookie, binding);

    /// <summary>Computes the proof that a client has a player's pass.</summary>
    internal static Token128 Prove(Token128 pass, ulong nonce, Token128 cookie, ReadOnlySpan<byte> binding = default)
    {
        byte[] key = new byte[Token128.Bytes];
        BinaryPrimitives.WriteUInt64LittleEndian(key, pass.First);
        BinaryPrimitives.WriteUInt64LittleEndian(key.AsSpan(sizeof(ulong)), pass.Second);
        using HMACSHA256 prover = new(key);
        CryptographicOperations.ZeroMemory(key);
        return Prove(prover, PassLabel, nonce, cookie, binding);
    }

    internal static bool IsProof(Token128 pass, in JoinDatagram join, ReadOnlySpan<byte> binding) =>
        join.PlayerProof == Prove(pass, join.Nonce, join.Cookie, binding);

    /// <summary>The session id of the n-th join of a session.</summary>
    internal ulong SessionId(ulong session, ulong join)
    {
        Span<byte> bytes = stackalloc byte[SessionLabel.Length + (2 * sizeof(ulong))];
        WireWriter writer = new(bytes);
        writer.WriteBytes(SessionLabel);
        writer.WriteUInt64(session);
        writer.WriteUInt64(join);
        return Hash(maker, bytes).First;
    }

    private static long Epoch(SimTime now) => now.Ticks / Age.Ticks;

    /// <summary>
    /// With the binding, a proof that was shown in one handshake is none in another: not at another host, and not to who reads the first one
    /// with the host's stolen identity.
    /// </summary>
    private static Token128 Prove(HMACSHA256 prover, ReadOnlySpan<byte> label, ulong nonce, Token128 cookie, ReadOnlySpan<byte> binding)
    {
        Span<byte> bytes = stackalloc byte[label.Length + sizeof(ulong) + Token128.Bytes + binding.Length];
        WireWriter writer = new(bytes);
        writer.WriteBytes(label);
        writer.WriteUInt64(nonce);
        cookie.Write(ref writer);
        writer.WriteBytes(binding);
        return Hash(prover, bytes);
    }

    private static Token128 Hash(HMACSHA256 hmac, ReadOnlySpan<byte> bytes)
    {
        Span<byte> hash = stackalloc byte[HashBytes];
        return hmac.TryComputeHash(bytes, hash, out _)
            ? new Token128(hash)
            : throw new InvalidOperationException($"SHA-256 gave more than {HashBytes} bytes.");
    }

    private Token128 Make(PeerAddress address, ulong nonce, long epoch, int key)
    {
        Span<byte> bytes = stackalloc byte[CookieLabel.Length + PeerAddress.Bytes + (2 * sizeof(ulong)) + 1];
        CookieLabel.CopyTo(bytes);
        Span<byte> rest = bytes.Slice(CookieLabel.Length);
        address.Write(rest);
        BinaryPrimitives.WriteUInt64LittleEndian(rest.Slice(PeerAddress.Bytes), nonce);
        BinaryPrimitives.WriteInt64LittleEndian(rest.Slice(PeerAddress.Bytes + sizeof(ulong)), epoch);
        bytes[bytes.Length - 1] = (byte)key;
        Token128 hash = Hash(maker, bytes);
        return new Token128((hash.First & ~KeyBits) | (uint)key, hash.Second);
    }
}
