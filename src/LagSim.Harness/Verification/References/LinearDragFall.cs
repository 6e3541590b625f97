using System;

namespace LagSim.Harness.Verification.References;

/// <summary>The closed form of a fall along a line under gravity and linear drag: v' = -g - k v.</summary>
/// <param name="gravity">m/s^2, downwards.</param>
/// <param name="k">Per second.</param>
internal sealed class LinearDragFall(double gravity, double k)
{
    /// <summary>The terminal velocity, in m/s.</summary>
    internal double Terminal => -gravity / k;

    /// <summary>Returns the velocity at a time after a velocity v.</summary>
    internal double Speed(double v, double seconds) => Terminal + ((v - Terminal) * Math.Exp(-k * seconds));

    /// <summary>Returns the height at a time after a height y and a velocity v.</summary>
    internal double Height(double y, double v, double seconds) => y + (Terminal * seconds) + ((v - Terminal) / k * (1 - Math.Exp(-k * seconds)));

    /// <summary>Returns the time at which the height is zero again, to a rounding, by bisection from the apex on; within 100 s.</summary>
    internal double Landing(double y, double v)
    {
        double low = v > 0 ? Math.Log((v - Terminal) / -Terminal) / k : 0, high = 100;
        for (int n = 0; n < 200; n++)
        {
            double middle = 0.5 * (low + high);
            (low, high) = Height(y, v, middle) > 0 ? (middle, high) : (low, middle);
        }

        return high;
    }
}
