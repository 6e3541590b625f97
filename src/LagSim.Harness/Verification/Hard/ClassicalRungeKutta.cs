using System.Collections.Generic;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Textbook integrators of x'' = f(t, x, v), written independently of the engine: its references, and wrong methods.
/// </summary>
internal static class ClassicalRungeKutta
{
    /// <summary>An acceleration as a function of time, position and velocity.</summary>
    internal delegate Vector3D Acceleration(double t, Vector3D x, Vector3D v);

    /// <summary>One step of some method.</summary>
    internal delegate (Vector3D X, Vector3D V) Method(Acceleration f, double t, Vector3D x, Vector3D v, double h);

    /// <summary>One step of the classical fourth-order method.</summary>
    internal static (Vector3D X, Vector3D V) Step(Acceleration f, double t, Vector3D x, Vector3D v, double h)
    {
        Vector3D k1 = f(t, x, v);
        Vector3D v2 = v + (k1 * (h / 2));
        Vector3D k2 = f(t + (h / 2), x + (v * (h / 2)), v2);
        Vector3D v3 = v + (k2 * (h / 2));
        Vector3D k3 = f(t + (h / 2), x + (v2 * (h / 2)), v3);
        Vector3D v4 = v + (k3 * h);
        Vector3D k4 = f(t + h, x + (v3 * h), v4);
        return (x + ((v + (v2 * 2) + (v3 * 2) + v4) * (h / 6)), v + ((k1 + (k2 * 2) + (k3 * 2) + k4) * (h / 6)));
    }

    /// <summary>One step of the midpoint method, of second order.</summary>
    internal static (Vector3D X, Vector3D V) Midpoint(Acceleration f, double t, Vector3D x, Vector3D v, double h)
    {
        Vector3D middle = v + (f(t, x, v) * (h / 2));
        return (x + (middle * h), v + (f(t + (h / 2), x + (v * (h / 2)), middle) * h));
    }

    /// <summary>
    /// The step of the thesis's code: fourth order for the velocity, and the position moved with the velocity at the end.
    /// </summary>
    internal static (Vector3D X, Vector3D V) ThesisStep(Acceleration f, double t, Vector3D x, Vector3D v, double h)
    {
        (_, Vector3D end) = Step(f, t, x, v, h);
        return (x + (end * h), end);
    }

    /// <summary>Fourth order between contacts with the plane y = floor, which act at the end of the step that crosses it.</summary>
    internal static Method Snapped(double floor, double e) => (f, t, x, v, h) =>
    {
        (x, v) = Step(f, t, x, v, h);
        return (x, x.Y < floor && v.Y < 0 ? V(v.X, -e * v.Y, v.Z) : v);
    };

    /// <summary>
    /// Returns the times at which a body that starts at rest bounces on y = 0 if each contact acts at the end of its step.
    /// </summary>
    internal static double[] SnappedTimes(Acceleration f, Vector3D x, double e, double h, int steps)
    {
        List<double> times = [];
        Vector3D v = default;
        Method method = Snapped(0, e);
        for (int n = 0; n < steps; n++)
        {
            double falling = v.Y;
            (x, v) = method(f, n * h, x, v, h);
            if (falling < 0 && v.Y > 0)
            {
                times.Add((n + 1) * h);
            }
        }

        return [.. times];
    }

    /// <summary>A number of steps from a state at time zero.</summary>
    internal static (Vector3D X, Vector3D V) Run(Method method, Acceleration f, Vector3D x, Vector3D v, double h, long steps)
    {
        for (long n = 0; n < steps; n++)
        {
            (x, v) = method(f, n * h, x, v, h);
        }

        return (x, v);
    }

    /// <summary>The same acceleration in the form of the textbook's method.</summary>
    internal static Acceleration Of(IAcceleration force) => (t, x, v) => force.At(t, x, v);

    /// <summary>The acceleration of 1 kg by a force of the library.</summary>
    internal static Acceleration Of(Force force, Vector3D gravity = default) => (t, x, v) => gravity + force.At(1, t, x, v, Vector3D.Zero);
}
