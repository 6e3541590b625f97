using System;
using LagSim.Harness.Experiments.Hands;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>
/// The course of a hand from the grab on: it lifts the ball off the floor within a second, does the motion, and throws. The ground truth of
/// frames.
/// </summary>
/// <remarks>
/// <para>The motion is played where it is at least half a metre clear of the floor, however it lies in its own coordinates, on straight
/// lines between its samples. In its last 0.2 s a throw comes on top of it: the first half of a stroke of 0.7 m, ahead and up, at whose
/// fastest instant the hand opens.</para>
/// <para>Immutable, safe on any thread.</para>
/// </remarks>
internal sealed class HandCourse
{
    internal const double BallRadius = 0.1;
    internal const double LiftSeconds = 1;
    internal const double ThrowSeconds = 0.2;

    /// <summary>The fastest playable hand, in m/s: the limit of a hold.</summary>
    internal const double FastestHand = 100;

    /// <summary>
    /// How far the lowest sample may lie below the first, in metres: the height to which the ball is lifted within a second.
    /// </summary>
    internal const double DeepestMetres = 20;

    /// <summary>The position of the ball's centre at the grab, which is the grab point.</summary>
    internal static readonly Vector3D Rest = new(0, BallRadius, 0);

    private const double Clearance = 0.5;
    private const double Frame = 1.0 / HandMotion.RateHertz;

    private readonly HandMotion motion;
    private readonly Vector3D origin; // the position of the motion's own origin
    private readonly MinimumJerkStroke lift;
    private readonly MinimumJerkStroke toss;

    /// <summary>Creates a course over the first seconds of a motion.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The duration is too short, too long, or longer than the motion.</exception>
    /// <exception cref="HandMotionException">The hand is too fast, or goes too deep.</exception>
    internal HandCourse(HandMotion motion, double seconds)
    {
        if (!(seconds >= HoldOptions.ShortestSeconds && seconds <= Math.Min(HoldOptions.LongestSeconds, motion.Seconds)))
        {
            throw new ArgumentOutOfRangeException(
                nameof(seconds), seconds,
                FormattableString.Invariant($"A hold lasts {HoldOptions.ShortestSeconds} to {HoldOptions.LongestSeconds} s and no longer than its motion, '{motion.Name}', {motion.Seconds} s."));
        }

        this.motion = motion;
        Seconds = seconds;
        double lowest = motion.PositionAt(0).Y;
        for (int n = 0; n <= Math.Ceiling(seconds * HandMotion.RateHertz) && n < motion.Count; n++)
        {
            lowest = Math.Min(lowest, motion.PositionAt(n).Y);
            double speed = motion.VelocityAt(n).Length;
            if (speed > FastestHand)
            {
                throw new HandMotionException(FormattableString.Invariant(
                    $"The hand motion '{motion.Name}' moves at {speed:G4} m/s {n * Frame:G4} s after its start; a hand that holds a ball is played at up to {FastestHand} m/s."));
            }
        }

        double depth = motion.PositionAt(0).Y - lowest;
        if (depth > DeepestMetres)
        {
            throw new HandMotionException(FormattableString.Invariant(
                $"The hand motion '{motion.Name}' goes {depth:G4} m below where it starts; a hand that holds a ball is played down to {DeepestMetres} m below."));
        }

        lift = new MinimumJerkStroke(0, LiftSeconds, new Vector3D(0, Clearance + depth, 0));
        toss = new MinimumJerkStroke(seconds - ThrowSeconds, 2 * ThrowSeconds, new Vector3D(0.5, 0.5, 0));
        origin = Rest + lift.Way - motion.PositionAt(0);
    }

    /// <summary>The duration of the motion.</summary>
    internal double Seconds { get; }

    /// <summary>The time of the release, in seconds after the grab.</summary>
    internal double Release => LiftSeconds + Seconds;

    /// <summary>
    /// Returns the position of the hand at a time after the grab, in seconds: at rest before the grab, at the end of the throw after the
    /// release.
    /// </summary>
    internal Vector3D At(double time)
    {
        double moved = Math.Clamp(time - LiftSeconds, 0, Seconds);
        if (time <= LiftSeconds)
        {
            return Rest + lift.At(time);
        }

        double place = moved * HandMotion.RateHertz;
        int n = Math.Min((int)place, motion.Count - 2);
        Vector3D at = motion.PositionAt(n);
        return origin + at + ((motion.PositionAt(n + 1) - at) * (place - n)) + toss.At(moved);
    }

    /// <summary>Returns the velocity as measured by a tracker at 120 Hz, which does not know later samples.</summary>
    internal Vector3D VelocityAt(double time) => (At(time) - At(time - Frame)) * HandMotion.RateHertz;
}
