using System;
using System.Globalization;

namespace LagSim.Scenes;

/// <summary>What a body or surface belongs to, and what it collides with: a category and a mask of 32 bits each, as in Box2D.</summary>
/// <remarks>
/// <para>Two collide only if each one's category has a bit in common with the other's mask. Two that do not are never tested: they pass
/// through each other, and neither carries the other. By default the category is 1 and the mask has all bits, so everything collides.</para>
/// <para>Immutable, safe on any thread. <c>default</c> is the default filter. A scene in which every filter is the default pays nothing for
/// filters.</para>
/// </remarks>
/// <example>
/// Ghosts that pass through each other but not through the floor, whose filter is the default:
/// <code>
/// CollisionFilter ghosts = new(category: 2, mask: 1);
/// BodySpec ghost = new(radius: 0.5, mass: 1, restitution: 0.7, filter: ghosts);
/// </code>
/// </example>
public readonly struct CollisionFilter : IEquatable<CollisionFilter>
{
    private const uint DefaultCategory = 1;

    private readonly uint category; // 0 is the default, so that default(CollisionFilter) is it
    private readonly uint mask;

    /// <summary>A filter of any bits.</summary>
    /// <param name="category">What it belongs to; no bit at all collides with nothing.</param>
    /// <param name="mask">The categories it collides with; 0 for none.</param>
    public CollisionFilter(uint category = DefaultCategory, uint mask = uint.MaxValue)
    {
        this.category = category ^ DefaultCategory;
        this.mask = ~mask;
    }

    /// <summary>The filter of what collides with nothing.</summary>
    public static CollisionFilter None => new(0, 0);

    /// <summary>What it belongs to; default 1.</summary>
    public uint Category => category ^ DefaultCategory;

    /// <summary>The categories it collides with; default all.</summary>
    public uint Mask => ~mask;

    /// <summary>Whether it is the default.</summary>
    public bool IsDefault => (category | mask) == 0;

    /// <summary>Both numbers in one; 0 for the default.</summary>
    internal ulong Packed => ((ulong)category << 32) | mask;

    /// <summary>Whether two that have these filters collide. It does not matter which of the two is asked.</summary>
    public bool CollidesWith(CollisionFilter other) => (Category & other.Mask) != 0 && (other.Category & Mask) != 0;

    /// <inheritdoc/>
    public bool Equals(CollisionFilter other) => category == other.category && mask == other.mask;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is CollisionFilter other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => unchecked((int)(category ^ (mask * 397)));

    /// <summary>Same bits.</summary>
    public static bool operator ==(CollisionFilter a, CollisionFilter b) => a.Equals(b);

    /// <summary>Different bits.</summary>
    public static bool operator !=(CollisionFilter a, CollisionFilter b) => !a.Equals(b);

    /// <summary>Category and mask in hexadecimal, such as <c>category 0x1, mask 0xffffffff</c>.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "category 0x{0:x}, mask 0x{1:x}", Category, Mask);
}
