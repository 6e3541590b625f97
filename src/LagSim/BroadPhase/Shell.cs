using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.BroadPhase;

/// <summary>A ball in which a body's centre stays for a while, whatever it does there: the shell of a Verlet list.</summary>
internal readonly struct Shell
{
    /// <summary>A bound on rounding, relative to a coordinate or the shell's radius: thousands of times the true rounding.</summary>
    private const double Slack = 1e-12;

    internal Shell(in Vector3D centre, double stray, double radius)
    {
        Centre = centre;
        Stray = stray;
        Extent = radius + stray + (Slack * (stray + Math.Abs(centre.X) + Math.Abs(centre.Y) + Math.Abs(centre.Z)));
    }

    /// <summary>Where it is, in metres; in a periodic box one of its images.</summary>
    internal Vector3D Centre { get; }

    /// <summary>How far the body's centre may be from that.</summary>
    internal double Stray { get; }

    /// <summary>How far from the centre any of the body may be.</summary>
    internal double Extent { get; }

    /// <summary>A shell around this one's centre in which the other lies too; of the same body.</summary>
    internal Shell Around(in Shell other)
    {
        double radius = Math.Max(Extent - Stray, other.Extent - other.Stray); // of the body, and what rounding may have moved
        return new Shell(Centre, Math.Max(Stray, (other.Centre - Centre).Length + other.Stray), radius);
    }

    /// <summary>
    /// The time until which a path surely stays in the shell, from a time at which it may be in it: <see cref="SimTime.MaxValue"/> if for
    /// the whole path, and the time itself if it is outside, or too near the edge to be certain.
    /// </summary>
    internal SimTime Leaves(in MotionSegment path, in DenseOutput dense, SimTime from, in PeriodicBox box)
    {
        if (double.IsPositiveInfinity(Stray))
        {
            return SimTime.MaxValue;
        }

        double seconds = from.SecondsSince(path.Epoch);
        Vector3D apart = box.Nearest(path.PositionAt(seconds, dense) - Centre);
        Vector3D velocity = path.VelocityAt(seconds, dense);
        double left = SecondsLeft(path, seconds);
        double acceleration = LargestAcceleration(path, dense, seconds, left);
        double stay = acceleration == 0 ? Straight(apart, velocity, Stray) : Curved(apart, velocity, acceleration);
        return stay > left ? SimTime.MaxValue : Later(from, stay);
    }

    /// <summary>
    /// An upper bound on the acceleration of a path from some seconds after its epoch and for a span after that, but not after its end: a
    /// polynomial means nothing there, and where forces are strong it ends soon.
    /// </summary>
    internal static double LargestAcceleration(in MotionSegment path, in DenseOutput dense, double seconds, double span)
    {
        double largest = path.Acceleration.Length;
        if (path.IsDense)
        {
            double s = Math.Abs(seconds) + Math.Min(span, SecondsLeft(path, seconds));
            largest += ((6 * dense.Cubic.Length) + (((12 * dense.Quartic.Length) + (20 * s * dense.Quintic.Length)) * s)) * s;
        }

        return largest;
    }

    // A tick more, because an event at the last one may lie half of one after it.
    private static double SecondsLeft(in MotionSegment path, double seconds) =>
        path.IsDense ? Math.Max(0, path.End.SecondsSince(path.Epoch) - seconds) + TickConversion.SecondsPerTick : double.PositiveInfinity;

    // A tick less, because an event at a tick may lie half of one after it.
    private static SimTime Later(SimTime from, double seconds)
    {
        double ticks = Math.Floor(seconds * SimDuration.TicksPerSecond) - 1;
        return !(ticks > 0) ? from
            : ticks < SimTime.MaxValue.Ticks / 2 && (long)ticks < SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks) ? SimTime.FromTicks(from.Ticks + (long)ticks)
            : SimTime.MaxValue;
    }

    // Three quarters for what the velocity does, one for what bends the path.
    private double Curved(in Vector3D apart, in Vector3D velocity, double acceleration) =>
        Math.Min(Straight(apart, velocity, 0.75 * Stray), Math.Sqrt(0.5 * Stray / acceleration));

    /// <summary>The root of |apart + velocity t| = stray, or zero if it is outside.</summary>
    private static double Straight(in Vector3D apart, in Vector3D velocity, double stray)
    {
        double room = (stray * stray) - apart.LengthSquared;
        double square = velocity.LengthSquared;
        if (!(room > 0))
        {
            return 0;
        }

        double along = Vector3D.Dot(apart, velocity);
        double root = Math.Sqrt((along * along) + (square * room));
        return along >= 0 ? room / (along + root) : (root - along) / square; // endless where the square is too small for a double
    }
}
