using System;
using LagSim.Scenes;

namespace LagSim.Motion;

/// <summary>How fast forces of which nothing is known change a deviation, seen from stages of a step that are of one time.</summary>
internal static class Stiffness
{
    /// <summary>A change of an acceleration by less than this part of it is rounding, and is ignored.</summary>
    private const double Significant = 1e-10;

    /// <summary>
    /// How much further a fixed step of the classical method reaches on the imaginary axis, 2 sqrt(2), than on the negative real one,
    /// 2.785.
    /// </summary>
    private const double Oscillation = 2.785 / 2.8284271247461903;

    /// <summary>
    /// The rate in 1/s: that of a damper, |a(x, v) - a(x, v')| / |v - v'|, or that of an oscillator, the root of |a(x, v') - a(x', v')| /
    /// |x - x'|, whichever is more.
    /// </summary>
    /// <param name="x">A position.</param>
    /// <param name="otherX">Another.</param>
    /// <param name="v">A velocity.</param>
    /// <param name="otherV">Another.</param>
    /// <param name="a">The acceleration at x with v.</param>
    /// <param name="between">The acceleration at x with the other velocity.</param>
    /// <param name="otherA">The acceleration at the other position with the other velocity.</param>
    internal static double Rate(
        in Vector3D x, in Vector3D otherX, in Vector3D v, in Vector3D otherV, in Vector3D a, in Vector3D between, in Vector3D otherA)
    {
        double damping = Quotient(a, between, (v - otherV).Length);
        double stiffness = Quotient(between, otherA, (x - otherX).Length);
        return Math.Max(damping, Oscillation * Math.Sqrt(stiffness));
    }

    private static double Quotient(in Vector3D a, in Vector3D b, double by)
    {
        double change = (a - b).Length;
        return change > Significant * a.Length && by > 0 ? change / by : 0;
    }
}
