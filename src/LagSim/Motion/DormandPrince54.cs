using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Motion;

/// <summary>
/// One step of the embedded Runge-Kutta method of orders 5 and 4 by Dormand and Prince (1980, J. Comp. Appl. Math. 6, 19-26) on position
/// and velocity: under error control, or of a fixed length.
/// </summary>
/// <remarks>
/// <para>Goes on with the fifth order (local extrapolation). The seventh stage is the acceleration at the end, which the quintic Hermite
/// polynomial between the ends needs too; with an error of O(h^6) in the position it keeps the order where a contact is found inside a
/// step.</para>
/// <para>A step is accepted if the estimate of its error is within the body's tolerance, in metres for the position and in m/s for the
/// velocity, or within a few roundings of them. The next one is 0.9 (tolerance / error)^(1/5) times as long, at least a fifth and at most
/// five times. So stiff forces are sub-stepped, and never blow up; fixed steps are halved until the rate of the forces lets them be, as
/// those of <see cref="RungeKutta4"/>.</para>
/// </remarks>
internal static class DormandPrince54
{
    /// <summary>The first step tried in a flight: 1/64 s. A smooth flight reaches the longest step in three steps.</summary>
    private static readonly SimDuration FirstTried = SimDuration.FromTicks(1L << 34);

    /// <summary>
    /// The largest product of rate and step of fixed steps: the end of the stability interval on the imaginary axis, which is less than a
    /// third of that on the negative real one.
    /// </summary>
    internal const double MaxRateTimesStep = FlightLaws.RateTimesStepOfDormandPrince54;

    /// <summary>The floor of an error estimate, relative to the terms that it is the difference of.</summary>
    private const double Rounding = 4 * 2.220446049250313e-16;

    /// <summary>One step from a state.</summary>
    /// <param name="forces">The accelerations.</param>
    /// <param name="spec">The body.</param>
    /// <param name="epoch">When the step begins.</param>
    /// <param name="x0">The position then.</param>
    /// <param name="v0">The velocity then.</param>
    /// <param name="spin">How the body turns, all the step.</param>
    /// <param name="tried">How long a step to try first, as the step before proposes it; zero if nothing does.</param>
    /// <param name="dense">The path's higher coefficients, and the next step to try.</param>
    /// <param name="error">
    /// The error in tolerances that even the shortest step has, infinite if it has no number; the step is then not to be used. Else zero.
    /// </param>
    /// <param name="rate">
    /// Of fixed steps the rate in 1/s that was met, where no step that may be taken is short enough for it; the step is then not to be
    /// used. Else zero.
    /// </param>
    internal static MotionSegment Step(
        in Forces forces, in BodySpec spec, SimTime epoch, in Vector3D x0, in Vector3D v0, in Vector3D spin, SimDuration tried, out DenseOutput dense,
        out double error, out double rate)
    {
        rate = 0;
        bool isFixed = spec.Tolerance == 0;
        SimDuration step = isFixed ? spec.Step : tried == SimDuration.Zero ? FirstTried : tried;
        double known = isFixed ? forces.FixedStepRateAt(spec, x0, v0, spin) : 0;
        Vector3D a1 = forces.At(spec, epoch, 0, x0, v0, spin);
        while (true)
        {
            double h = step.ToSeconds();
            Vector3D v2 = v0 + (a1 * (h / 5));
            Vector3D a2 = forces.At(spec, epoch, h / 5, x0 + (v0 * (h / 5)), v2, spin);

            Vector3D x3 = x0 + (((v0 * (3.0 / 40)) + (v2 * (9.0 / 40))) * h);
            Vector3D v3 = v0 + (((a1 * (3.0 / 40)) + (a2 * (9.0 / 40))) * h);
            Vector3D a3 = forces.At(spec, epoch, h * (3.0 / 10), x3, v3, spin);

            Vector3D x4 = x0 + (((v0 * (44.0 / 45)) - (v2 * (56.0 / 15)) + (v3 * (32.0 / 9))) * h);
            Vector3D v4 = v0 + (((a1 * (44.0 / 45)) - (a2 * (56.0 / 15)) + (a3 * (32.0 / 9))) * h);
            Vector3D a4 = forces.At(spec, epoch, h * (4.0 / 5), x4, v4, spin);

            Vector3D x5 = x0 + (((v0 * (19372.0 / 6561)) - (v2 * (25360.0 / 2187)) + (v3 * (64448.0 / 6561)) - (v4 * (212.0 / 729))) * h);
            Vector3D v5 = v0 + (((a1 * (19372.0 / 6561)) - (a2 * (25360.0 / 2187)) + (a3 * (64448.0 / 6561)) - (a4 * (212.0 / 729))) * h);
            Vector3D a5 = forces.At(spec, epoch, h * (8.0 / 9), x5, v5, spin);

            Vector3D x6 = x0 + (((v0 * (9017.0 / 3168)) - (v2 * (355.0 / 33)) + (v3 * (46732.0 / 5247)) + (v4 * (49.0 / 176)) - (v5 * (5103.0 / 18656))) * h);
            Vector3D v6 = v0 + (((a1 * (9017.0 / 3168)) - (a2 * (355.0 / 33)) + (a3 * (46732.0 / 5247)) + (a4 * (49.0 / 176)) - (a5 * (5103.0 / 18656))) * h);
            Vector3D a6 = forces.At(spec, epoch, h, x6, v6, spin);

            Vector3D dx = Fifth(v0, v3, v4, v5, v6) * h;
            Vector3D dv = Fifth(a1, a3, a4, a5, a6) * h;
            Vector3D v7 = v0 + dv;
            Vector3D a7 = forces.At(spec, epoch, h, x0 + dx, v7, spin);
            if (isFixed)
            {
                error = 0;
                rate = Math.Max(known, forces.FixedStepRateAt(spec, x0 + dx, v7, spin)); // a step may lead to where forces are stiffer
                if (forces.HasSupplied(spec))
                {
                    Vector3D x7 = x0 + dx;
                    rate = Math.Max(rate, Stiffness.Rate(x7, x6, v7, v6, a7, forces.At(spec, epoch, h, x7, v6, spin), a6));
                }

                bool isStable = rate * h <= MaxRateTimesStep; // what is not a number is not
                if (!isStable && step.Ticks >= 2 * Limits.MinStep.Ticks)
                {
                    step = SimDuration.FromTicks(step.Ticks / 2);
                    continue;
                }

                rate = isStable ? 0 : double.IsNaN(rate) ? double.PositiveInfinity : rate;
                dense = DenseOutput.Between(h, dx, dv, v0, a1, a7);
                return new MotionSegment(MotionLaw.DormandPrince54, epoch, epoch + step, x0, v0, a1);
            }

            double moved = Math.Max(x0.Length + (v0.Length * h), a1.Length * h * h); // the last where it starts at rest at the origin
            double missX = Difference(v0, v3, v4, v5, v6, v7).Length * h / (spec.Tolerance + (Rounding * moved));
            double missV = Difference(a1, a3, a4, a5, a6, a7).Length * h / (spec.Tolerance + (Rounding * (v0.Length + (a1.Length * h))));
            error = Math.Max(missX, missV);
            bool isAccepted = error <= 1; // what is not a number is not
            if (isAccepted || step == StepSize.Shortest)
            {
                dense = DenseOutput.Between(h, dx, dv, v0, a1, a7, StepSize.Scaled(step, isAccepted ? Math.Min(5, Factor(error)) : 1));
                error = isAccepted ? 0 : double.IsNaN(error) ? double.PositiveInfinity : error;
                return new MotionSegment(MotionLaw.DormandPrince54, epoch, epoch + step, x0, v0, a1);
            }

            step = StepSize.Scaled(step, double.IsFinite(error) ? Math.Max(0.2, Math.Min(0.9, Factor(error))) : 0.1);
        }
    }

    private static Vector3D Fifth(in Vector3D k1, in Vector3D k3, in Vector3D k4, in Vector3D k5, in Vector3D k6) =>
        (k1 * (35.0 / 384)) + (k3 * (500.0 / 1113)) + (k4 * (125.0 / 192)) - (k5 * (2187.0 / 6784)) + (k6 * (11.0 / 84));

    /// <summary>The weights of the fifth order less those of the fourth.</summary>
    private static Vector3D Difference(in Vector3D k1, in Vector3D k3, in Vector3D k4, in Vector3D k5, in Vector3D k6, in Vector3D k7) =>
        (k1 * (71.0 / 57600)) - (k3 * (71.0 / 16695)) + (k4 * (71.0 / 1920)) - (k5 * (17253.0 / 339200)) + (k6 * (22.0 / 525)) - (k7 * (1.0 / 40));

    /// <summary>0.9 times the fifth root of 1 / error, as far as it lies within what a step may change by.</summary>
    private static double Factor(double error) => 0.9 / StepSize.Root(Math.Min(1e4, Math.Max(1e-4, error)), 5);
}
