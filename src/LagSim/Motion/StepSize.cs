using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// How long a step may be whose length follows from an error: its limits, and roots of what gives the same bits everywhere.
/// </summary>
internal static class StepSize
{
    /// <summary>The longest: 1 s.</summary>
    internal static readonly SimDuration Longest = SimDuration.FromTicks(SimDuration.TicksPerSecond);

    /// <summary>The shortest step.</summary>
    internal static readonly SimDuration Shortest = Limits.ShortestStep;

    /// <summary>A step made so many times as long, within the limits.</summary>
    internal static SimDuration Scaled(SimDuration step, double factor)
    {
        long ticks = (long)(step.Ticks * factor);
        return SimDuration.FromTicks(Math.Max(Shortest.Ticks, Math.Min(Longest.Ticks, ticks)));
    }

    /// <summary>
    /// A root of a positive number, to about 1e-5, as good as the size of a step needs to be. Newton's method from above, where it falls
    /// monotonically; made of nothing but multiplication and division.
    /// </summary>
    /// <param name="number">Above zero, 1e-30 to 1e30.</param>
    /// <param name="degree">2 or more.</param>
    internal static double Root(double number, int degree)
    {
        double root = 1;
        while (Power(root, degree) < number)
        {
            root *= 2;
        }

        while (Power(0.5 * root, degree) >= number)
        {
            root *= 0.5;
        }

        while (true)
        {
            double next = (((degree - 1) * root) + (number / Power(root, degree - 1))) / degree;
            if (!(next < root * 0.99999))
            {
                return next;
            }

            root = next;
        }
    }

    private static double Power(double number, int exponent)
    {
        double power = number;
        for (int i = 1; i < exponent; i++)
        {
            power *= number;
        }

        return power;
    }
}
