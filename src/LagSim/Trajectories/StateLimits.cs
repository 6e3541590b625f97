using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Trajectories;

/// <summary>How fast a body may become, and when a closed form would exceed that.</summary>
internal sealed class StateLimits(Scene scene)
{
    /// <summary>All of time, from its least to its largest value, in seconds.</summary>
    private const double LongestSpan = 1L << 24;

    private readonly Scene scene = scene;

    /// <summary>
    /// The time when a closed form would exceed the permitted speed: the only root of |v + a t| = limit. Beyond the range of a time except
    /// for the smallest bodies and the strongest gravity.
    /// </summary>
    internal SimTime EndOfRange(SimTime from, in Vector3D velocity, in Vector3D acceleration)
    {
        double limit = Limits.MaxSpeed(scene.SmallestRadius);
        double a = acceleration.LengthSquared;
        if (4 * velocity.LengthSquared <= limit * limit && 4 * a * LongestSpan * LongestSpan <= limit * limit)
        {
            return SimTime.MaxValue; // neither half can fill the limit
        }

        double b = Vector3D.Dot(velocity, acceleration);
        double c = velocity.LengthSquared - (limit * limit);
        double root = Math.Sqrt((b * b) - (a * c));
        double seconds = b > 0 ? -c / (b + root) : (root - b) / a; // 0 / 0 without acceleration
        return TickConversion.TryFromSeconds(seconds, out long ticks) && ticks <= SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks)
            ? from + SimDuration.FromTicks(ticks)
            : SimTime.MaxValue;
    }

    /// <summary>
    /// The time when a flight in a periodic box ends and the next begins: after an eighth of the least side. Until then two bodies come
    /// nearer by at most a quarter of that side, and they touch at less than another quarter. So the images that are nearest when both
    /// paths are open are the ones that can meet.
    /// </summary>
    internal SimTime EndOfFlight(SimTime from, in Vector3D velocity)
    {
        double seconds = PeriodicBox.FlightPart * scene.Box.MinSide / velocity.Length;
        return TickConversion.TryFromSeconds(seconds, out long ticks) && ticks <= SimTime.MaxValue.Ticks - Math.Max(0, from.Ticks)
            ? from + SimDuration.FromTicks(ticks)
            : SimTime.MaxValue;
    }

    /// <summary>Whether a body may be in a state: the position is finite, and the speed within the limit.</summary>
    internal bool Allow(in Vector3D position, in Vector3D velocity) =>
        position.IsFinite && velocity.Length <= Limits.MaxSpeed(scene.SmallestRadius);
}
