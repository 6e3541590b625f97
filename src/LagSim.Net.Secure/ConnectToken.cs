using System;
using System.Buffers.Binary;
using System.Runtime.InteropServices;
using System.Text;
using Org.BouncyCastle.Math.EC.Rfc8032;

namespace LagSim.Net.Protection;

/// <summary>
/// The bytes of a connect token: what a backend says, and its Ed25519 signature (RFC 8032). docs/SECURITY.md has the layout.
/// </summary>
internal static class ConnectToken
{
    /// <summary>The length of what identifies a token among all of its issuer.</summary>
    internal const int IdBytes = 16;

    private const int PrintBytes = HostFingerprint.Bytes;
    private const int IssuerAt = 4;
    private const int RightsAt = IssuerAt + 4;
    private const int NumberAt = RightsAt + 1;
    private const int FromAt = NumberAt + 1;
    private const int UntilAt = FromAt + sizeof(long);
    private const int IdAt = UntilAt + sizeof(long);
    private const int HostAt = IdAt + IdBytes;
    private const int TextsAt = HostAt + PrintBytes;

    private static ReadOnlySpan<byte> Magic => "LST1"u8;

    /// <summary>Writes and signs a token.</summary>
    internal static byte[] Write(
        PlayerAdmission admission, HostFingerprint host, DateTimeOffset from, DateTimeOffset until, ReadOnlySpan<byte> id, TokenKey issuer,
        byte[] privateKey)
    {
        byte[] player = Encoding.UTF8.GetBytes(admission.PlayerId);
        byte[] name = Encoding.UTF8.GetBytes(admission.Name);
        int length = TextsAt + 1 + player.Length + 1 + name.Length;
        byte[] token = new byte[length + Ed25519.SignatureSize];
        Magic.CopyTo(token);
        WriteIssuer(issuer, token.AsSpan(IssuerAt));
        token[RightsAt] = (byte)admission.Rights;
        token[NumberAt] = admission.Number;
        BinaryPrimitives.WriteInt64LittleEndian(token.AsSpan(FromAt), from.ToUnixTimeSeconds());
        BinaryPrimitives.WriteInt64LittleEndian(token.AsSpan(UntilAt), until.ToUnixTimeSeconds());
        id.CopyTo(token.AsSpan(IdAt));
        host.Write(token.AsSpan(HostAt));
        token[TextsAt] = (byte)player.Length;
        player.CopyTo(token, TextsAt + 1);
        token[TextsAt + 1 + player.Length] = (byte)name.Length;
        name.CopyTo(token, TextsAt + 1 + player.Length + 1);
        Ed25519.Sign(privateKey, 0, token, 0, length, token, length);
        return token;
    }

    /// <summary>Reads a token, and checks all but whether it was used.</summary>
    internal static TokenReading Read(ReadOnlySpan<byte> token, HostFingerprint host, TokenKey issuer, DateTimeOffset now)
    {
        if (!IsWhole(token))
        {
            return new TokenReading(TokenFault.Damaged);
        }

        Span<byte> print = stackalloc byte[sizeof(uint)];
        WriteIssuer(issuer, print);
        if (!token.Slice(IssuerAt, print.Length).SequenceEqual(print))
        {
            return new TokenReading(TokenFault.OtherIssuer);
        }

        byte[] bytes = token.ToArray();
        int length = bytes.Length - Ed25519.SignatureSize;
        if (!Ed25519.Verify(bytes, length, issuer.Bytes.ToArray(), 0, bytes, 0, length))
        {
            return new TokenReading(TokenFault.Damaged);
        }

        Span<byte> wanted = stackalloc byte[PrintBytes];
        host.Write(wanted);
        if (!token.Slice(HostAt, PrintBytes).SequenceEqual(wanted))
        {
            return new TokenReading(TokenFault.OtherHost);
        }

        long seconds = now.ToUnixTimeSeconds();
        long from = BinaryPrimitives.ReadInt64LittleEndian(token.Slice(FromAt));
        long until = BinaryPrimitives.ReadInt64LittleEndian(token.Slice(UntilAt));
        return seconds < from ? new TokenReading(TokenFault.NotYetValid, Span(from - seconds))
            : seconds >= until ? new TokenReading(TokenFault.Expired, Span(seconds - until))
            : Admission(bytes);
    }

    /// <summary>What identifies a whole token, and when it expires, in seconds since 1970.</summary>
    internal static bool TryReadId(ReadOnlySpan<byte> token, out (ulong, ulong) id, out long until)
    {
        bool isWhole = IsWhole(token);
        id = isWhole
            ? (BinaryPrimitives.ReadUInt64LittleEndian(token.Slice(IdAt)),
                BinaryPrimitives.ReadUInt64LittleEndian(token.Slice(IdAt + sizeof(ulong))))
            : default;
        until = isWhole ? BinaryPrimitives.ReadInt64LittleEndian(token.Slice(UntilAt)) : 0;
        return isWhole;
    }

    private static TokenReading Admission(byte[] token)
    {
        int player = token[TextsAt];
        int name = token[TextsAt + 1 + player];
        try
        {
            UTF8Encoding strict = new(false, throwOnInvalidBytes: true);
            return new TokenReading(new PlayerAdmission(
                strict.GetString(token, TextsAt + 1, player),
                strict.GetString(token, TextsAt + 1 + player + 1, name),
                (PlayerRights)token[RightsAt],
                token[NumberAt]));
        }
        catch (ArgumentException)
        {
            return new TokenReading(TokenFault.Damaged); // signed all the same: the issuer is not one of LagSim's
        }
    }

    private static bool IsWhole(ReadOnlySpan<byte> token)
    {
        if (token.Length < TextsAt + 2 + Ed25519.SignatureSize || !token.Slice(0, Magic.Length).SequenceEqual(Magic))
        {
            return false;
        }

        int texts = TextsAt + 1 + ByteAt(token, TextsAt);
        return texts < token.Length - Ed25519.SignatureSize && texts + 1 + ByteAt(token, texts) + Ed25519.SignatureSize == token.Length;
    }

    /// <summary>One byte of a span, without its indexer, which some Mono runtimes cannot link (docs/ARCHITECTURE.md).</summary>
    private static byte ByteAt(ReadOnlySpan<byte> bytes, int index) => MemoryMarshal.Read<byte>(bytes.Slice(index));

    private static void WriteIssuer(TokenKey issuer, Span<byte> destination)
    {
        Span<byte> hash = stackalloc byte[Sha256.Bytes];
        Sha256.Hash(issuer.Bytes, default, hash);
        hash.Slice(0, sizeof(uint)).CopyTo(destination);
    }

    private static TimeSpan Span(long seconds) => TimeSpan.FromSeconds(Math.Clamp(seconds, 0, int.MaxValue));
}
