using System;
using System.Globalization;
using System.Text;

namespace LagSim.Scenes;

/// <summary>Which of a scene's forces act on a body besides gravity; none by default.</summary>
/// <remarks>
/// Immutable, safe on any thread. <see cref="SceneBuilder.AddForce(Force, out ForceSet)"/> makes the set of one; <c>|</c> joins two.
/// </remarks>
public readonly struct ForceSet : IEquatable<ForceSet>
{
    /// <summary>The most forces a scene has.</summary>
    public const int MaxForces = 32;

    private ForceSet(uint mask) => Mask = mask;

    /// <summary>No force but gravity; also <c>default</c>.</summary>
    public static ForceSet None => default;

    /// <summary>Bit n for the scene's n-th force, counted from 0.</summary>
    public uint Mask { get; }

    /// <summary>Whether nothing but gravity acts.</summary>
    public bool IsEmpty => Mask == 0;

    /// <summary>The set of the scene's n-th force alone, counted from 0.</summary>
    /// <exception cref="ArgumentOutOfRangeException">Below 0, or not below <see cref="MaxForces"/>.</exception>
    public static ForceSet Of(int number) =>
        number is >= 0 and < MaxForces
            ? new ForceSet(1U << number)
            : throw new ArgumentOutOfRangeException(nameof(number), number, $"A scene's forces are numbered 0 to {MaxForces - 1}.");

    /// <summary>The set of those bits.</summary>
    public static ForceSet FromMask(uint mask) => new(mask);

    /// <summary>Whether the scene's n-th force, counted from 0, is one of them.</summary>
    public bool Contains(int number) => number is >= 0 and < MaxForces && (Mask & (1U << number)) != 0;

    /// <summary>The forces of both.</summary>
    public static ForceSet operator |(ForceSet a, ForceSet b) => new(a.Mask | b.Mask);

    /// <summary>The same forces.</summary>
    public static bool operator ==(ForceSet a, ForceSet b) => a.Mask == b.Mask;

    /// <summary>Not the same forces.</summary>
    public static bool operator !=(ForceSet a, ForceSet b) => a.Mask != b.Mask;

    /// <inheritdoc/>
    public bool Equals(ForceSet other) => Mask == other.Mask;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is ForceSet other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => (int)Mask;

    /// <summary>The numbers of the forces, as <c>{0, 2}</c>.</summary>
    public override string ToString()
    {
        StringBuilder text = new("{");
        for (int n = 0; n < MaxForces; n++)
        {
            if (Contains(n))
            {
                text.Append(text.Length > 1 ? ", " : "").Append(n.ToString(CultureInfo.InvariantCulture));
            }
        }

        return text.Append('}').ToString();
    }

    /// <summary>The names of those of a scene's forces that are in the set, for a message.</summary>
    internal string NamesAmong(Force[] forces)
    {
        StringBuilder text = new();
        foreach (Force force in Among(forces))
        {
            text.Append(text.Length > 0 ? ", '" : "'").Append(force.Name).Append('\'');
        }

        return text.ToString();
    }

    /// <summary>Those of a scene's forces that are in the set, in the scene's order.</summary>
    internal ActingForces Among(Force[] forces) => new(forces, Mask);

    /// <summary>How many forces there are up to the last that is in the set.</summary>
    internal int UpTo
    {
        get
        {
            int count = 0;
            for (uint left = Mask; left != 0; left >>= 1)
            {
                count++;
            }

            return count;
        }
    }
}
