using System;
using LagSim.Scenes;

namespace LagSim.Timelines;

/// <summary>
/// A contact that a body of an island carries from step to step: the other body or surface, and the impulses of the last step on this body.
/// </summary>
/// <remarks>Immutable. It is part of the body's segment, in snapshots and hashes too, because the next step begins with it.</remarks>
public readonly struct PersistentContact : IEquatable<PersistentContact>
{
    /// <summary>In place of a surface where the contact is with another body.</summary>
    public const int NoSurface = -1;

    /// <summary>A contact with another body.</summary>
    /// <param name="partner">See <see cref="Partner"/>.</param>
    /// <param name="surface">See <see cref="Surface"/>.</param>
    /// <param name="holds">See <see cref="Holds"/>.</param>
    /// <param name="push">See <see cref="Push"/>.</param>
    /// <param name="turn">See <see cref="Turn"/>.</param>
    /// <param name="solved">See <see cref="Solved"/>.</param>
    public PersistentContact(BodyId partner, int surface, bool holds, in Vector3D push = default, in Vector3D turn = default, bool solved = false)
    {
        Partner = partner;
        Surface = surface;
        Holds = holds;
        Push = push;
        Turn = turn;
        Solved = solved;
    }

    /// <summary>The other body; this one itself where it is a static surface.</summary>
    public BodyId Partner { get; }

    /// <summary>Which static surface: planes by index, static spheres after them; or <see cref="NoSurface"/>.</summary>
    public int Surface { get; }

    /// <summary>Whether it holds the two together from step to step, and not for this step alone because they might touch in it.</summary>
    public bool Holds { get; }

    /// <summary>The impulse along the normal and of friction, in N s.</summary>
    public Vector3D Push { get; }

    /// <summary>The angular impulse of rolling resistance, in N m s.</summary>
    public Vector3D Turn { get; }

    /// <summary>
    /// Whether the impact by a hand that opened the segment has solved it, a surface that holds: it may press no further, and what that left
    /// to close is the step's, not an impact's.
    /// </summary>
    public bool Solved { get; }

    /// <summary>The same contact as a later segment of the step carries it.</summary>
    internal PersistentContact GoingOn => new(Partner, Surface, Holds, Push, Turn);

    /// <summary>Whether every part is the same, to the bit.</summary>
    public bool Equals(PersistentContact other) => Partner == other.Partner && Surface == other.Surface && Holds == other.Holds
        && Solved == other.Solved && Push.Equals(other.Push) && Turn.Equals(other.Turn);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is PersistentContact other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Partner.GetHashCode() ^ (Surface * 397) ^ Push.GetHashCode();

    /// <summary>Same contact with the same impulses, to the bit.</summary>
    public static bool operator ==(PersistentContact a, PersistentContact b) => a.Equals(b);

    /// <summary>Some part differs.</summary>
    public static bool operator !=(PersistentContact a, PersistentContact b) => !a.Equals(b);
}
