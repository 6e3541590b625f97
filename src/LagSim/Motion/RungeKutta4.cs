using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// One step of the classical fourth-order Runge-Kutta method on position and velocity, with dense output between its ends.
/// </summary>
/// <remarks>
/// <para>Dense output is the quintic Hermite polynomial through position, velocity and acceleration at both ends. Its error, O(h^6) in the
/// position and O(h^5) in the velocity, stays below the method's own, so a contact found inside a step keeps the order.</para>
/// <para>The method multiplies what decays at a rate lambda by more than one once lambda h is above 2.785 (Hairer and Wanner, Solving
/// Ordinary Differential Equations II, IV.2), and blows up. So a step is halved until the rate of the forces lets it be: of the scene's own
/// forces it is known, of a program's it is estimated from two stages and one more evaluation.</para>
/// </remarks>
internal static class RungeKutta4
{
    /// <summary>
    /// The largest product of rate and step: the end of the stability interval on the negative real axis, a little below that on the
    /// imaginary one.
    /// </summary>
    internal const double MaxRateTimesStep = FlightLaws.RateTimesStepOfRungeKutta4;

    /// <summary>One step from a state, of the body's step or so many halvings of it as its forces need.</summary>
    /// <param name="forces">The accelerations.</param>
    /// <param name="spec">The body.</param>
    /// <param name="epoch">When the step begins.</param>
    /// <param name="x0">The position then.</param>
    /// <param name="v0">The velocity then.</param>
    /// <param name="spin">How the body turns, all the step.</param>
    /// <param name="dense">The path's higher coefficients.</param>
    /// <param name="rate">
    /// The rate in 1/s that was met, where no step that may be taken is short enough for it; the step is then not to be used. Else zero.
    /// </param>
    internal static MotionSegment Step(
        in Forces forces, in BodySpec spec, SimTime epoch, in Vector3D x0, in Vector3D v0, in Vector3D spin, out DenseOutput dense, out double rate)
    {
        SimDuration step = spec.Step;
        double known = spec.Forces.IsEmpty ? 0 : forces.FixedStepRateAt(spec, x0, v0, spin);
        bool estimates = !spec.Forces.IsEmpty && forces.HasSupplied(spec);
        while (known * step.ToSeconds() > MaxRateTimesStep && step.Ticks >= 2 * Limits.MinStep.Ticks)
        {
            step = SimDuration.FromTicks(step.Ticks / 2);
        }

        while (true)
        {
            double h = step.ToSeconds();
            Vector3D a0 = forces.At(spec, epoch, 0, x0, v0, spin);
            Vector3D v2 = v0 + (a0 * (0.5 * h));
            Vector3D a2 = forces.At(spec, epoch, 0.5 * h, x0 + (v0 * (0.5 * h)), v2, spin);
            Vector3D v3 = v0 + (a2 * (0.5 * h));
            Vector3D a3 = forces.At(spec, epoch, 0.5 * h, x0 + (v2 * (0.5 * h)), v3, spin);
            Vector3D v4 = v0 + (a3 * h);
            Vector3D a4 = forces.At(spec, epoch, h, x0 + (v3 * h), v4, spin);
            Vector3D dx = (v0 + ((v2 + v3) * 2) + v4) * (h / 6);
            Vector3D dv = (a0 + ((a2 + a3) * 2) + a4) * (h / 6);
            Vector3D a1 = forces.At(spec, epoch, h, x0 + dx, v0 + dv, spin);
            dense = DenseOutput.Between(h, dx, dv, v0, a0, a1);

            // a step may lead to where forces are stiffer
            rate = spec.Forces.IsEmpty ? 0 : Math.Max(known, forces.FixedStepRateAt(spec, x0 + dx, v0 + dv, spin));
            if (estimates)
            {
                Vector3D x2 = x0 + (v0 * (0.5 * h));
                Vector3D x3 = x0 + (v2 * (0.5 * h));
                rate = Math.Max(rate, Stiffness.Rate(x3, x2, v3, v2, a3, forces.At(spec, epoch, 0.5 * h, x3, v2, spin), a2));
            }

            bool isStable = rate * h <= MaxRateTimesStep; // what is not a number is not
            if (isStable || step.Ticks < 2 * Limits.MinStep.Ticks)
            {
                rate = isStable ? 0 : double.IsNaN(rate) ? double.PositiveInfinity : rate;
                return new MotionSegment(MotionLaw.RungeKutta4, epoch, epoch + step, x0, v0, a0);
            }

            step = SimDuration.FromTicks(step.Ticks / 2);
        }
    }
}
