using System;

namespace LagSim.Collisions;

/// <summary>When a gap that is a parabola first closes, in closed form and without cancellation.</summary>
internal static class Quadratic
{
    /// <summary>As <see cref="RootIsolation.Find"/>, for f(t) = c0 + c1 t + c2 t^2 and all t >= 0.</summary>
    internal static double FirstDescent(double c0, double c1, double c2)
    {
        if (c0 <= 0)
        {
            if (c1 < 0 || (c1 == 0 && c2 < 0))
            {
                return 0;
            }

            if (!(c2 < 0))
            {
                return double.NaN; // opening for good
            }

            // Opening, and falling back later: onto the surface, or, where it never left the overlap, from its apex on.
            double lift = (c1 * c1) - (4 * c2 * c0);
            return lift > 0 ? (c1 + Math.Sqrt(lift)) / (-2 * c2) : c1 / (-2 * c2);
        }

        if (c2 == 0)
        {
            return c1 < 0 ? -c0 / c1 : double.NaN;
        }

        double discriminant = (c1 * c1) - (4 * c2 * c0);
        if (c2 < 0)
        {
            double root = Math.Sqrt(discriminant); // c0 > 0 > c2: always positive
            return c1 <= 0 ? 2 * c0 / (root - c1) : (c1 + root) / (-2 * c2);
        }

        return c1 < 0 && discriminant > 0 ? 2 * c0 / (Math.Sqrt(discriminant) - c1) : double.NaN;
    }
}
