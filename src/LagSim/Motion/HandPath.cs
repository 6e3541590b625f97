using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// How a hand is assumed to move after its last keyframe: the one rule by which every peer extrapolates, and by which a sender foresees
/// what they do.
/// </summary>
/// <remarks>
/// <para>From a keyframe on the hand brakes evenly, from the keyframe's velocity to rest, for <see cref="Stops"/>, and then keeps still: so
/// it never gets further from the keyframe than half the way that it would have gone. The held body converges on that within
/// <see cref="Settles"/>, by a cubic, without a jump in position or velocity.</para>
/// <para>Pure functions, safe on any thread.</para>
/// </remarks>
public static class HandPath
{
    /// <summary>
    /// How long a held body takes to converge on what its newest keyframe foretells: 50 ms. Shorter than that a correction is a jerk that
    /// throws what lies in its way; longer, and at usual rates of keyframes the body never gets to where the hand is.
    /// </summary>
    public static readonly SimDuration Settles = SimDuration.FromMilliseconds(50);

    /// <summary>
    /// The time that a hand takes to come to rest if no more keyframes come: 300 ms, about as long as one movement of a hand continues one
    /// way. A shorter braking needs more keyframes for the same error, and a longer one hardly fewer, but goes further astray where a hand
    /// turns back.
    /// </summary>
    public static readonly SimDuration Stops = SimDuration.FromMilliseconds(300);

    /// <summary>
    /// The time that a hold lasts after its last keyframe, or its grab: 1 s. A hand that keeps a body still has to send keyframes more
    /// often than that.
    /// </summary>
    public static readonly SimDuration Lasts = SimDuration.FromSeconds(1);

    /// <summary>Where the hand is taken to be so long after a keyframe, in metres; <paramref name="since"/> is at least zero.</summary>
    public static Vector3D Position(in Vector3D keyframe, in Vector3D velocity, SimDuration since)
    {
        double stops = Stops.ToSeconds();
        double s = since < Stops ? since.ToSeconds() : stops;
        return keyframe + (velocity * (s - (s * s / (2 * stops))));
    }

    /// <summary>How fast the hand is taken to be so long after a keyframe, in m/s; <paramref name="since"/> is at least zero.</summary>
    public static Vector3D Velocity(in Vector3D velocity, SimDuration since)
    {
        double stops = Stops.ToSeconds();
        return since < Stops ? velocity * (1 - (since.ToSeconds() / stops)) : Vector3D.Zero;
    }

    /// <summary>
    /// The path from a pose at a keyframe to what the keyframe foretells: the foretold braking, and the error of pose and velocity times
    /// the cubic that takes both to zero, (1 - s/T)^2 (e + (e' + 2 e/T) s).
    /// </summary>
    internal static MotionSegment Converge(
        SimTime time, in Vector3D position, in Vector3D velocity, in Vector3D target, in Vector3D targetVelocity, out DenseOutput dense)
    {
        double t = Settles.ToSeconds();
        Vector3D error = position - target;
        Vector3D slope = velocity - targetVelocity;
        Vector3D q = slope + (error * (2 / t));
        Vector3D bend = ((error / (t * t)) - (q * (2 / t))) * 2;
        dense = new DenseOutput(q / (t * t), Vector3D.Zero, Vector3D.Zero);
        return new MotionSegment(MotionLaw.Held, time, time + Settles, position, velocity, bend - (targetVelocity / Stops.ToSeconds()));
    }

    /// <summary>The rest of the braking, from the end of the convergence on.</summary>
    internal static MotionSegment Brake(SimTime time, SimTime keyframe, in Vector3D position, in Vector3D velocity)
    {
        SimTime end = keyframe + Stops;
        return new MotionSegment(MotionLaw.Held, time, end, position, velocity, velocity / -end.SecondsSince(time));
    }

    /// <summary>Still in the hand, until the hold ends by itself.</summary>
    internal static MotionSegment Still(SimTime time, SimTime keyframe, in Vector3D position) =>
        new(MotionLaw.Held, time, keyframe + Lasts, position, Vector3D.Zero, Vector3D.Zero);

    /// <summary>
    /// No less than the highest speed on a held path, in m/s: the largest of its velocity's three Bernstein coefficients.
    /// </summary>
    internal static double SpeedBound(in MotionSegment segment, in DenseOutput dense)
    {
        double t = segment.End.SecondsSince(segment.Epoch);
        double first = segment.Velocity.Length;
        double second = (segment.Velocity + (segment.Acceleration * (0.5 * t))).Length;
        double third = segment.VelocityAt(t, dense).Length;
        return System.Math.Max(first, System.Math.Max(second, third));
    }
}
