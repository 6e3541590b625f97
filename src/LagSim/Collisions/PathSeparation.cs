using System;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Collisions;

/// <summary>Whether two spheres on any paths surely stay apart over a span, without looking for the root.</summary>
/// <remarks>
/// <para>Along the line n between where they begin, their distance is at least |d0| plus the sum of min(0, n·dk) T^k over the terms dk of
/// their relative path, in a span of T seconds. If that is above their reach, a plane across n separates them all the time.</para>
/// <para>In doubt it answers no, and <see cref="TimeOfImpact"/> is asked, so it changes no bit of the result. It only saves time: in a heal
/// a body is tested against every piece of the others' paths, nearly all of which are far away.</para>
/// </remarks>
internal static class PathSeparation
{
    /// <summary>Whether they stay apart from a time on, on which both paths are open, until another. A tick more is included.</summary>
    /// <param name="a">One path.</param>
    /// <param name="denseA">Its further terms.</param>
    /// <param name="b">The other path.</param>
    /// <param name="denseB">Its further terms.</param>
    /// <param name="reach">The distance, in metres, up to which they do not count as apart.</param>
    /// <param name="from">When the span begins.</param>
    /// <param name="until">When it ends; no earlier.</param>
    internal static bool AreApart(
        in MotionSegment a, in DenseOutput denseA, in MotionSegment b, in DenseOutput denseB, double reach, SimTime from, SimTime until)
    {
        Span<Vector3D> path = stackalloc Vector3D[TimeOfImpact.PathLength];
        Span<Vector3D> other = stackalloc Vector3D[TimeOfImpact.PathLength];
        int length = Math.Max(TimeOfImpact.Path(a, denseA, from, path), TimeOfImpact.Path(b, denseB, from, other));
        Vector3D between = path[0] - other[0];
        double square = between.LengthSquared;
        double span = TimeOfImpact.Seconds(from, until) + TickConversion.SecondsPerTick;
        double window = Math.Max(1, span); // the least in which a root is looked for, so that its rounding is that of terms as large
        double power = 1, windowPower = 1, nearest = square, size = path[0].Taxicab + other[0].Taxicab + reach;
        for (int k = 1; k < length; k++)
        {
            power *= span;
            windowPower *= window;
            Vector3D term = path[k] - other[k];
            nearest += Math.Min(0, Vector3D.Dot(between, term) * power);
            size += (path[k].Taxicab + other[k].Taxicab) * windowPower;
        }

        // (nearest / |d0|)² > reach², without the division. Rounding is in proportion to the square of the summed terms.
        return nearest > 0 && nearest * nearest > square * ((reach * reach) + (FreeFlights.Slack * size * size)); // false if anything is not a number
    }
}
