using System;

namespace LagSim.Harness.Verification.References;

/// <summary>The closed form of a flight along a line under gravity and quadratic drag: v' = -g - k v |v|.</summary>
/// <param name="gravity">m/s^2, downwards.</param>
/// <param name="k">Per metre.</param>
internal sealed class QuadraticDragFall(double gravity, double k)
{
    /// <summary>The terminal speed, in m/s.</summary>
    internal double Terminal { get; } = Math.Sqrt(gravity / k);

    /// <summary>Returns the distance fallen from rest after a time, in metres.</summary>
    internal double Fallen(double seconds) => Terminal * Terminal / gravity * Math.Log(Math.Cosh(gravity * seconds / Terminal));

    /// <summary>Returns the time from a height, upwards at a speed or at rest, to height zero, and the speed there.</summary>
    internal (double Seconds, double Speed) Landing(double height, double up)
    {
        double apex = Terminal / gravity * Math.Atan(up / Terminal);
        double top = height + (Terminal * Terminal / (2 * gravity) * Math.Log(1 + (up * up / (Terminal * Terminal))));
        double grown = Math.Exp(gravity * top / (Terminal * Terminal));
        return (apex + (Terminal / gravity * Math.Acosh(grown)), Terminal * Math.Sqrt(1 - (1 / (grown * grown))));
    }
}
