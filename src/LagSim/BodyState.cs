using LagSim.Scenes;

namespace LagSim;

/// <summary>Where a body is at an instant, how fast it moves and by which law.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct BodyState
{
    internal BodyState(Vector3D position, Vector3D velocity, MotionLaw motion, Vector3D spin = default, CollisionFilter filter = default)
    {
        Spin = spin;
        Position = position;
        Velocity = velocity;
        Motion = motion;
        Filter = filter;
    }

    /// <summary>The centre, in metres.</summary>
    public Vector3D Position { get; }

    /// <summary>The velocity of the centre, in metres per second.</summary>
    public Vector3D Velocity { get; }

    /// <summary>
    /// The spin, in radians per second about the vector; zero for a body without friction that was not given any. A resting body may turn
    /// too: only rolling resistance resists turning about the normal of the surface it lies on, and without friction nothing resists
    /// turning at all.
    /// </summary>
    public Vector3D Spin { get; }

    /// <summary>The law it moves by; <see cref="MotionLaw.Absent"/> if it is not there.</summary>
    public MotionLaw Motion { get; }

    /// <summary>What it collides with.</summary>
    public CollisionFilter Filter { get; }

    /// <summary>Whether every bit of position, velocity and spin, the law and the filter are the same.</summary>
    public bool IsSameBits(in BodyState other) =>
        Motion == other.Motion && Filter == other.Filter && IsSame(Position, other.Position) && IsSame(Velocity, other.Velocity) && IsSame(Spin, other.Spin);

    private static bool IsSame(in Vector3D a, in Vector3D b) => Bits(a.X) == Bits(b.X) && Bits(a.Y) == Bits(b.Y) && Bits(a.Z) == Bits(b.Z);

    // -0.0 counts as 0.0, as in every hash.
    private static long Bits(double value) => System.BitConverter.DoubleToInt64Bits(value + 0.0);
}
