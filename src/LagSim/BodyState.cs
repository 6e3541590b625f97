using LagSim.Scenes;

namespace LagSim;

/// <summary>Where a body is at an instant, how fast it moves and by which law.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public readonly struct BodyState
{
    internal BodyState(Vector3D position, Vector3D velocity, MotionLaw motion)
    {
        Position = position;
        Velocity = velocity;
        Motion = motion;
    }

    /// <summary>The centre, in metres.</summary>
    public Vector3D Position { get; }

    /// <summary>Metres per second.</summary>
    public Vector3D Velocity { get; }

    /// <summary>The law it moves by; <see cref="MotionLaw.Absent"/> if it is not there.</summary>
    public MotionLaw Motion { get; }

    /// <summary>Whether every bit of position and velocity, and the law, are the same.</summary>
    public bool IsSameBits(in BodyState other) =>
        Motion == other.Motion && Bits(Position.X) == Bits(other.Position.X) && Bits(Position.Y) == Bits(other.Position.Y)
        && Bits(Position.Z) == Bits(other.Position.Z) && Bits(Velocity.X) == Bits(other.Velocity.X)
        && Bits(Velocity.Y) == Bits(other.Velocity.Y) && Bits(Velocity.Z) == Bits(other.Velocity.Z);

    // -0.0 counts as 0.0, as in every hash.
    private static long Bits(double value) => System.BitConverter.DoubleToInt64Bits(value + 0.0);
}
