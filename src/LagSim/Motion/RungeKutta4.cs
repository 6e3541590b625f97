using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>One step of the classical fourth-order Runge-Kutta method on position and velocity, with dense output between its ends.</summary>
/// <remarks>
/// Dense output is the quintic Hermite polynomial through position, velocity and acceleration at both ends. Its error, O(h^6) in the
/// position and O(h^5) in the velocity, stays below the method's own, so a contact found inside a step keeps the order.
/// </remarks>
internal static class RungeKutta4
{
    internal static MotionSegment Step(
        in Forces forces, in BodySpec spec, SimTime epoch, in Vector3D x0, in Vector3D v0, out DenseOutput dense)
    {
        SimTime end = epoch + spec.Step;
        double h = spec.Step.ToSeconds();
        byte field = spec.Acceleration;

        Vector3D a0 = forces.At(field, epoch, 0, x0, v0);
        Vector3D v2 = v0 + (a0 * (0.5 * h));
        Vector3D a2 = forces.At(field, epoch, 0.5 * h, x0 + (v0 * (0.5 * h)), v2);
        Vector3D v3 = v0 + (a2 * (0.5 * h));
        Vector3D a3 = forces.At(field, epoch, 0.5 * h, x0 + (v2 * (0.5 * h)), v3);
        Vector3D v4 = v0 + (a3 * h);
        Vector3D a4 = forces.At(field, epoch, h, x0 + (v3 * h), v4);
        Vector3D dx = (v0 + ((v2 + v3) * 2) + v4) * (h / 6);
        Vector3D dv = (a0 + ((a2 + a3) * 2) + a4) * (h / 6);
        Vector3D a1 = forces.At(field, epoch, h, x0 + dx, v0 + dv);

        // What the parabola from the start misses at the end, scaled to the size of a third derivative.
        Vector3D p = (dx - ((v0 + (a0 * (0.5 * h))) * h)) / (h * h * h);
        Vector3D q = (dv - (a0 * h)) / (h * h);
        Vector3D r = (a1 - a0) / h;
        dense = new DenseOutput(
            (p * 10) - (q * 4) + (r * 0.5),
            ((q * 7) - (p * 15) - r) / h,
            ((p * 6) - (q * 3) + (r * 0.5)) / (h * h));
        return new MotionSegment(MotionLaw.RungeKutta4, epoch, end, x0, v0, a0);
    }

    /// <summary>The state at the step's end, which the next step starts from.</summary>
    internal static void End(in MotionSegment step, in DenseOutput dense, out Vector3D position, out Vector3D velocity)
    {
        double h = step.End.SecondsSince(step.Epoch);
        position = step.PositionAt(h, dense);
        velocity = step.VelocityAt(h, dense);
    }
}
