using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// One immutable piece of a body's path: a law, its epoch and state there, and how long its formula holds. Only a successor ends it
/// earlier.
/// </summary>
internal readonly struct MotionSegment
{
    internal MotionSegment(
        MotionLaw law,
        SimTime epoch,
        SimTime end,
        in Vector3D position,
        in Vector3D velocity,
        in Vector3D acceleration,
        SupportSet supports = default,
        LossReason loss = LossReason.None)
    {
        Law = law;
        Loss = loss;
        Epoch = epoch;
        End = end;
        Position = position;
        Velocity = velocity;
        Acceleration = acceleration;
        Supports = supports;
    }

    /// <summary>The instant at which the state below holds; the formula counts its time from here.</summary>
    internal SimTime Epoch { get; }

    /// <summary>
    /// The last instant for which the formula was made: the step's or law's own end, whatever cuts it short.
    /// <see cref="SimTime.MaxValue"/>: none.
    /// </summary>
    internal SimTime End { get; }

    internal MotionLaw Law { get; }

    /// <summary>
    /// Why the body can be followed no further than to this segment, which lasts no time; <see cref="LossReason.None"/> of any other.
    /// </summary>
    internal LossReason Loss { get; }

    internal Vector3D Position { get; }

    internal Vector3D Velocity { get; }

    /// <summary>The acceleration at the epoch; constant where the law is a closed form.</summary>
    internal Vector3D Acceleration { get; }

    internal SupportSet Supports { get; }

    internal bool IsPresent => Law != MotionLaw.Absent;

    /// <summary>Whether the formula has more terms than the acceleration's.</summary>
    internal bool IsDense => ((1 << (int)Law) & DenseLaws) != 0;

    private const int DenseLaws =
        (1 << (int)MotionLaw.RungeKutta4) | (1 << (int)MotionLaw.Held) | (1 << (int)MotionLaw.ClosedForm) | (1 << (int)MotionLaw.DormandPrince54);

    /// <summary>
    /// Whether the body is one of an island: it is in persistent contact with others, or with what no closed form carries it on, and moves
    /// or rests there.
    /// </summary>
    internal bool IsOfIsland => Law == MotionLaw.Constrained || (Law == MotionLaw.Resting && Supports.Count == 0);

    /// <summary>A path that never moves: a static sphere, or a body at rest.</summary>
    internal static MotionSegment AtRest(SimTime epoch, in Vector3D position, SupportSet supports = default) =>
        new(MotionLaw.Resting, epoch, SimTime.MaxValue, position, Vector3D.Zero, Vector3D.Zero, supports);

    /// <summary>Whether every part is the same, to the bit.</summary>
    internal bool IsSameAs(in MotionSegment other) =>
        (Law, Loss, Epoch, End) == (other.Law, other.Loss, other.Epoch, other.End)
        && Position.Equals(other.Position) && Velocity.Equals(other.Velocity) && Acceleration.Equals(other.Acceleration) && Supports.Equals(other.Supports);

    /// <summary>The same motion from another place.</summary>
    internal MotionSegment At(in Vector3D position) => new(Law, Epoch, End, position, Velocity, Acceleration, Supports);

    /// <summary>No body.</summary>
    internal static MotionSegment Nothing(SimTime epoch) =>
        new(MotionLaw.Absent, epoch, SimTime.MaxValue, Vector3D.Zero, Vector3D.Zero, Vector3D.Zero);

    /// <summary>No body any more, because it cannot be followed from a state on. It ends at once, with the event that tells so.</summary>
    internal static MotionSegment Lost(SimTime epoch, in Vector3D position, in Vector3D velocity, LossReason why) => new(
        MotionLaw.Absent, epoch, epoch, Known(position), Known(velocity), Vector3D.Zero, default, why);

    private static Vector3D Known(in Vector3D value) => value.IsFinite ? value.WithoutNegativeZero() : Vector3D.Zero;

    /// <summary>Where the formula is <paramref name="seconds"/> after the epoch.</summary>
    internal Vector3D PositionAt(double seconds, in DenseOutput dense)
    {
        if (Law == MotionLaw.Resting)
        {
            return Position;
        }

        Vector3D quadratic = Position + ((Velocity + (Acceleration * (0.5 * seconds))) * seconds);
        return !IsDense
            ? quadratic
            : quadratic + ((dense.Cubic + ((dense.Quartic + (dense.Quintic * seconds)) * seconds)) * (seconds * seconds * seconds));
    }

    /// <summary>How fast the formula moves <paramref name="seconds"/> after the epoch.</summary>
    internal Vector3D VelocityAt(double seconds, in DenseOutput dense)
    {
        if (Law == MotionLaw.Resting)
        {
            return Vector3D.Zero;
        }

        Vector3D linear = Velocity + (Acceleration * seconds);
        return !IsDense
            ? linear
            : linear + (((dense.Cubic * 3) + (((dense.Quartic * 4) + (dense.Quintic * (5 * seconds))) * seconds)) * (seconds * seconds));
    }

    internal Vector3D AccelerationAt(double seconds, in DenseOutput dense) =>
        !IsDense
            ? Acceleration
            : Acceleration + (((dense.Cubic * 6) + (((dense.Quartic * 12) + (dense.Quintic * (20 * seconds))) * seconds)) * seconds);
}
