using System;
using System.Buffers.Binary;

namespace LagSim.Net.Protection;

/// <summary>
/// What identifies a host: the first 16 bytes of the SHA-256 of its public key, written as 32 lower-case hexadecimal digits.
/// </summary>
/// <remarks>
/// It is no secret. Nobody can make another identity with the same fingerprint: that takes 2^128 tries. Immutable, safe on any thread.
/// <c>default</c> is no host's.
/// </remarks>
public readonly struct HostFingerprint : IEquatable<HostFingerprint>
{
    /// <summary>The length of <see cref="ToString"/>, in characters.</summary>
    public const int TextLength = 2 * Bytes;

    internal const int Bytes = 16;

    private readonly ulong high;
    private readonly ulong low;

    private HostFingerprint(ReadOnlySpan<byte> bytes)
    {
        high = BinaryPrimitives.ReadUInt64BigEndian(bytes);
        low = BinaryPrimitives.ReadUInt64BigEndian(bytes.Slice(sizeof(ulong)));
    }

    /// <summary>The fingerprint of a host's public key.</summary>
    internal static HostFingerprint OfPublicKey(ReadOnlySpan<byte> publicKey)
    {
        Span<byte> hash = stackalloc byte[Sha256.Bytes];
        Sha256.Hash(publicKey, default, hash);
        return new HostFingerprint(hash);
    }

    /// <summary>Reads the text of a fingerprint.</summary>
    /// <param name="text">32 hexadecimal digits, lower case; nothing else is one.</param>
    /// <param name="fingerprint">The fingerprint.</param>
    /// <returns>False if the text is none. Never throws.</returns>
    public static bool TryParse(string? text, out HostFingerprint fingerprint)
    {
        Span<byte> bytes = stackalloc byte[Bytes];
        bool isOne = text is not null && HexText.TryRead(text, bytes);
        fingerprint = isOne ? new HostFingerprint(bytes) : default;
        return isOne;
    }

    /// <summary>Reads the first 16 bytes.</summary>
    internal static HostFingerprint Read(ReadOnlySpan<byte> bytes) => new(bytes);

    internal void Write(Span<byte> destination)
    {
        BinaryPrimitives.WriteUInt64BigEndian(destination, high);
        BinaryPrimitives.WriteUInt64BigEndian(destination.Slice(sizeof(ulong)), low);
    }

    /// <inheritdoc/>
    public bool Equals(HostFingerprint other) => high == other.high && low == other.low;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is HostFingerprint other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => high.GetHashCode();

    /// <summary>Same fingerprint.</summary>
    public static bool operator ==(HostFingerprint a, HostFingerprint b) => a.Equals(b);

    /// <summary>Different fingerprints.</summary>
    public static bool operator !=(HostFingerprint a, HostFingerprint b) => !a.Equals(b);

    /// <summary>The 32 digits.</summary>
    public override string ToString() => FormattableString.Invariant($"{high:x16}{low:x16}");
}
