using System;

namespace LagSim.Tests.Behavior;

/// <summary>What a contact tolerance d promises, computed here and not asked of the engine: bounds of tests of persistent contact.</summary>
internal static class Tolerance
{
    /// <summary>
    /// Contact steps a second: a step is the largest power of two of seconds that is at most 1/64 and in which a fall stays within d.
    /// </summary>
    internal static double StepsASecond(double d, double gravity = TestWorlds.Gravity)
    {
        double steps = 64;
        while (1 / steps > Math.Sqrt(2 * d / gravity))
        {
            steps *= 2;
        }

        return steps;
    }

    /// <summary>
    /// How many bounces there are, from a first fall, until the last: it rises less than d, and all to come would be over in a step.
    /// </summary>
    internal static double BouncesUntilLast(double fall, double e, double d)
    {
        double rebound = e * Math.Sqrt(2 * TestWorlds.Gravity * fall);
        double last = Math.Min(Math.Sqrt(2 * TestWorlds.Gravity * d), 0.5 * TestWorlds.Gravity * (1 - e) / StepsASecond(d));
        return e > 0 ? 1 + Math.Max(0, Math.Ceiling(Math.Log(rebound / last) / Math.Log(1 / e))) : 1;
    }
}
