using System;
using LagSim.Scenes;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>A solid sphere that slips against rolling resistance, by its equations: v its velocity, q = r w x n that with which it would roll.</summary>
/// <remarks>
/// Friction takes mu N from v along v - q, and its moment gives 5/2 of that to q; the moment c N r of resistance takes 5/2 c N from q along q, where N is what presses, by mass.
/// </remarks>
internal static class ResistedSlip
{
    /// <summary>How it moves, how it turns, how far it has come, and when it began to roll; NaN if it did not.</summary>
    internal readonly record struct OnALine(double V, double Q, double Way, double Rolls);

    /// <summary>On a level floor with v and q on one line, where everything is even between the instants at which v - q, q or v becomes zero.</summary>
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

    /// <summary>On a plane, where v and q need not be on one line, by so many classical Runge-Kutta steps; while it slips and turns.</summary>
    internal static (Vector3D X, Vector3D V, Vector3D Q) After(double seconds, int steps, double mu, double c, double pressing, Vector3D pull, Vector3D v, Vector3D q)
    {
        Vector3D x = default;
        double h = seconds / steps;
        for (int n = 0; n < steps; n++)
        {
            (Vector3D a1, Vector3D b1) = Rate(v, q);
            (Vector3D a2, Vector3D b2) = Rate(v + (a1 * (h / 2)), q + (b1 * (h / 2)));
            (Vector3D a3, Vector3D b3) = Rate(v + (a2 * (h / 2)), q + (b2 * (h / 2)));
            (Vector3D a4, Vector3D b4) = Rate(v + (a3 * h), q + (b3 * h));
            x += (v * h) + ((a1 + a2 + a3) * (h * h / 6));
            v += (a1 + (a2 * 2) + (a3 * 2) + a4) * (h / 6);
            q += (b1 + (b2 * 2) + (b3 * 2) + b4) * (h / 6);
        }

        return (x, v, q);

        (Vector3D A, Vector3D B) Rate(Vector3D v, Vector3D q)
        {
            Vector3D rub = (v - q) * (mu * pressing / (v - q).Length);
            return (pull - rub, (rub - (q * (c * pressing / q.Length))) * 2.5);
        }
    }
}
