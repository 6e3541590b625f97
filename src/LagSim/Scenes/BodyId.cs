using System;
using System.Globalization;

namespace LagSim.Scenes;

/// <summary>
/// The identity of a body, the same on every peer: (peer, sequence) of the event that spawned it and its index in that event; (0, 0, index)
/// for a scene's own.
/// </summary>
/// <remarks>
/// <para>Order is by peer, then sequence, then index. It decides operand order and ties, so an array slot never does.</para>
/// <para>Ranges: peer 0 to 255, sequence 0 to 4,294,967,295, index 0 to 16,777,215; packed into one 64-bit value.</para>
/// <para>Immutable, safe on any thread. <c>default</c> is the scene's first body.</para>
/// </remarks>
public readonly struct BodyId : IEquatable<BodyId>, IComparable<BodyId>
{
    /// <summary>The highest index a body can have.</summary>
    public const int MaxIndex = (1 << 24) - 1;

    private BodyId(ulong packed) => Packed = packed;

    /// <summary>The body that event (<paramref name="peer"/>, <paramref name="sequence"/>) spawned.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="index"/> is negative or above <see cref="MaxIndex"/>.</exception>
    public BodyId(byte peer, uint sequence, int index)
    {
        if (index is < 0 or > MaxIndex)
        {
            throw new ArgumentOutOfRangeException(nameof(index), index, $"A body's index is 0 to {MaxIndex}.");
        }

        Packed = ((ulong)peer << 56) | ((ulong)sequence << 24) | (uint)index;
    }

    /// <summary>The peer whose event spawned the body; 0 for a scene's own.</summary>
    public byte Peer => (byte)(Packed >> 56);

    /// <summary>The sequence number of the event that spawned the body; 0 for a scene's own.</summary>
    public uint Sequence => (uint)(Packed >> 24);

    /// <summary>The index within what spawned it.</summary>
    public int Index => (int)(Packed & MaxIndex);

    /// <summary>All three in one number whose order is the identity's order; this is what travels and is hashed.</summary>
    public ulong Packed { get; }

    /// <summary>The identity of a scene's own body.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="index"/> is negative or above <see cref="MaxIndex"/>.</exception>
    public static BodyId OfScene(int index) => new(0, 0, index);

    /// <summary>The identity that <see cref="Packed"/> gave; every 64-bit value is one.</summary>
    public static BodyId FromPacked(ulong packed) => new(packed);

    /// <inheritdoc/>
    public bool Equals(BodyId other) => Packed == other.Packed;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is BodyId other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Packed.GetHashCode();

    /// <inheritdoc/>
    public int CompareTo(BodyId other) => Packed.CompareTo(other.Packed);

    /// <summary>Same body.</summary>
    public static bool operator ==(BodyId a, BodyId b) => a.Packed == b.Packed;

    /// <summary>Different bodies.</summary>
    public static bool operator !=(BodyId a, BodyId b) => a.Packed != b.Packed;

    /// <summary>Before in the canonical order.</summary>
    public static bool operator <(BodyId a, BodyId b) => a.Packed < b.Packed;

    /// <summary>After in the canonical order.</summary>
    public static bool operator >(BodyId a, BodyId b) => a.Packed > b.Packed;

    /// <summary>Not after in the canonical order.</summary>
    public static bool operator <=(BodyId a, BodyId b) => a.Packed <= b.Packed;

    /// <summary>Not before in the canonical order.</summary>
    public static bool operator >=(BodyId a, BodyId b) => a.Packed >= b.Packed;

    /// <summary><c>peer.sequence.index</c>.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "{0}.{1}.{2}", Peer, Sequence, Index);
}
