using System;
using System.Buffers.Binary;
using System.Security.Cryptography;

namespace LagSim.Net.Wire;

/// <summary>Sixteen bytes that only the holder of a secret can make.</summary>
/// <remarks>Immutable, safe on any thread. Comparison takes constant time, by the system's function.</remarks>
internal readonly struct Token128 : IEquatable<Token128>
{
    /// <summary>The length in bytes.</summary>
    public const int Bytes = 16;

    private readonly ulong low;
    private readonly ulong high;

    /// <summary>Takes the first sixteen bytes of a span.</summary>
    /// <exception cref="ArgumentException">There are fewer.</exception>
    public Token128(ReadOnlySpan<byte> source)
    {
        if (source.Length < Bytes)
        {
            throw new ArgumentException($"A token has {Bytes} bytes; these are {source.Length}.", nameof(source));
        }

        low = BinaryPrimitives.ReadUInt64LittleEndian(source);
        high = BinaryPrimitives.ReadUInt64LittleEndian(source.Slice(sizeof(ulong)));
    }

    internal Token128(ulong low, ulong high)
    {
        this.low = low;
        this.high = high;
    }

    /// <summary>The first eight bytes.</summary>
    internal ulong First => low;

    /// <summary>The other eight bytes.</summary>
    internal ulong Second => high;

    /// <inheritdoc/>
    public bool Equals(Token128 other)
    {
        Span<byte> mine = stackalloc byte[Bytes];
        Span<byte> its = stackalloc byte[Bytes];
        CopyTo(mine);
        other.CopyTo(its);
        return CryptographicOperations.FixedTimeEquals(mine, its);
    }

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is Token128 other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => (low ^ high).GetHashCode();

    /// <summary>Same bytes.</summary>
    public static bool operator ==(Token128 a, Token128 b) => a.Equals(b);

    /// <summary>Different bytes.</summary>
    public static bool operator !=(Token128 a, Token128 b) => !a.Equals(b);

    internal void CopyTo(Span<byte> destination)
    {
        BinaryPrimitives.WriteUInt64LittleEndian(destination, low);
        BinaryPrimitives.WriteUInt64LittleEndian(destination.Slice(sizeof(ulong)), high);
    }

    internal static Token128 Read(ref WireReader reader) => new(reader.ReadUInt64(), reader.ReadUInt64());

    internal void Write(ref WireWriter writer)
    {
        writer.WriteUInt64(low);
        writer.WriteUInt64(high);
    }
}
