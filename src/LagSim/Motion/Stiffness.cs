using System;
using LagSim.Scenes;

namespace LagSim.Motion;

/// <summary>How fast forces change a deviation, seen from two stages of a step that are of one time.</summary>
internal static class Stiffness
{
    private const double Sqrt5 = 2.23606797749979;

    /// <summary>
    /// The rate in 1/s: the lambda with |da| = lambda |dv| + lambda² |dx|, for da is that of a damper and an oscillator of the true rate together at most. Of a damper alone, where
    /// dx = dv / rate, that is the rate times (sqrt(5) - 1) / 2, by which it is divided; of an oscillator no more than the rate.
    /// </summary>
    internal static double Rate(in Vector3D dx, in Vector3D dv, in Vector3D da)
    {
        double a = da.Length;
        double v = dv.Length;
        double sum = v + Math.Sqrt((v * v) + (4 * dx.Length * a));
        return sum > 0 ? (1 + Sqrt5) * a / sum : 0;
    }
}
