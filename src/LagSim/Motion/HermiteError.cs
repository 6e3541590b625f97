using System;

namespace LagSim.Motion;

/// <summary>
/// How far a quintic Hermite polynomial strays from the path of which it has position, velocity and acceleration at both ends.
/// </summary>
/// <remarks>
/// At most h^6 |x^(6)| / 46080 in the position and sqrt(5) h^5 |x^(6)| / 30000 in the velocity, with the largest sixth derivative in the
/// step (Birkhoff and Priver 1967, J. Math. and Phys. 46, 440-447).
/// </remarks>
internal static class HermiteError
{
    private const double Position = 46080;
    private const double Velocity = 13416.407864998738; // 30000 / sqrt(5)

    /// <summary>
    /// The longest step, in seconds, within which the polynomial is off by no more than a tolerance, or by rounding where that is more.
    /// </summary>
    /// <param name="tolerance">The tolerance, in metres and in m/s.</param>
    /// <param name="size">The size at which the position is rounded, in metres.</param>
    /// <param name="speed">The size at which the velocity is rounded, in m/s, at the start.</param>
    /// <param name="acceleration">By how much it changes in a second, in m/s²: at a turning point there is no speed, but after a step there
    /// is this much.</param>
    /// <param name="sixth">The sixth derivative's size at the start.</param>
    /// <param name="seventh">How fast the sixth changes at most: |x^(6)| stays below sixth + t seventh.</param>
    /// <param name="most">No longer than this, in seconds.</param>
    internal static double LongestStep(double tolerance, double size, double speed, double acceleration, double sixth, double seventh, double most)
    {
        const double rounding = 2.220446049250313e-16;
        double x = 0.5 * Position * Math.Max(tolerance, rounding * size); // half for each of the two terms
        double v = 0.5 * Velocity * Math.Max(tolerance, rounding * speed);
        double h = most;
        h = Shorter(h, x, sixth, 6);
        h = Shorter(h, x, seventh, 7);
        double change = 0.5 * Velocity * rounding * acceleration; // in a second: of both conditions a power of h goes
        return Math.Max(Shorter(Shorter(h, v, sixth, 5), v, seventh, 6), Shorter(Shorter(h, change, sixth, 4), change, seventh, 5));
    }

    /// <summary>
    /// Limits a step to the h with h^n derivative = allowed. A value that is not a number changes nothing here: it is found where the state
    /// is checked.
    /// </summary>
    private static double Shorter(double h, double allowed, double derivative, int n)
    {
        double power = h;
        for (int i = 1; i < n; i++)
        {
            power *= h;
        }

        return power * derivative > allowed ? Math.Min(h, StepSize.Root(Math.Max(1e-300, allowed / derivative), n)) : h;
    }
}
