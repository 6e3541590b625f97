using System;
using LagSim.Scenes;
using MathNet.Numerics.LinearAlgebra;
using MathNet.Numerics.OdeSolvers;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A solid sphere that slips against rolling resistance, by its equations: v its velocity, q = r w x n the velocity at which it would roll.
/// </summary>
/// <remarks>
/// Friction takes mu N from v along v - q, and its moment adds 5/2 of that to q. The moment c N r of resistance takes 5/2 c N from q along
/// q. N is the normal force divided by the mass.
/// </remarks>
internal static class ResistedSlip
{
    /// <summary>The velocity, the rolling velocity, the distance, and the time at which it began to roll; NaN if it did not.</summary>
    internal readonly record struct OnALine(double V, double Q, double Way, double Rolls);

    /// <summary>
    /// On a level floor with v and q on one line, where accelerations are constant between the instants at which v - q, q or v becomes
    /// zero.
    /// </summary>
    internal static OnALine After(double seconds, double mu, double c, double v, double q)
    {
        double way = 0, t = 0, rolls = double.NaN;
        while (t < seconds && (v != 0 || q != 0))
        {
            double a, b, ends = double.PositiveInfinity;
            bool isSlip = v != q, stopsTurning = false;
            if (isSlip)
            {
                double slip = Math.Sign(v - q), over = q != 0 ? Math.Sign(q) : slip;
                (a, b) = (-mu * Gravity * slip, 2.5 * Gravity * ((mu * slip) - (c * over)));
                ends = (v - q) / (b - a);
                stopsTurning = q * b < 0 && -q / b < ends;
                ends = stopsTurning ? -q / b : ends;
            }
            else
            {
                rolls = double.IsNaN(rolls) ? t : rolls;
                a = b = -5.0 / 7 * c * Gravity * Math.Sign(v);
                ends = -v / a;
            }

            double passes = Math.Min(ends, seconds - t);
            way += (v + (a * passes / 2)) * passes;
            bool isOver = ends <= seconds - t;
            v += a * passes;
            q = !isOver ? q + (b * passes) : stopsTurning ? 0 : v;
            (v, q) = isOver && !isSlip ? (0, 0) : (v, q);
            t += passes;
        }

        return new OnALine(v, q, way, rolls);
    }

    /// <summary>
    /// On a plane, where v and q need not be on one line, by a number of steps of MathNet's Runge-Kutta method of order four, while it
    /// slips and turns.
    /// </summary>
    internal static (Vector3D X, Vector3D V, Vector3D Q) After(double seconds, int steps, double mu, double c, double pressing, Vector3D pull, Vector3D v, Vector3D q)
    {
        Vector<double> start = Vector<double>.Build.Dense([0, 0, 0, v.X, v.Y, v.Z, q.X, q.Y, q.Z]);
        Vector<double> end = RungeKutta.FourthOrder(start, 0, seconds, steps + 1, (_, state) => Rate(At(state, 3), At(state, 6)))[^1];
        return (At(end, 0), At(end, 3), At(end, 6));

        static Vector3D At(Vector<double> state, int first) => V(state[first], state[first + 1], state[first + 2]);

        Vector<double> Rate(in Vector3D v, in Vector3D q)
        {
            Vector3D frictionImpulse = (v - q) * (mu * pressing / (v - q).Length), a = pull - frictionImpulse, b = (frictionImpulse - (q * (c * pressing / q.Length))) * 2.5;
            return Vector<double>.Build.Dense([v.X, v.Y, v.Z, a.X, a.Y, a.Z, b.X, b.Y, b.Z]);
        }
    }
}
