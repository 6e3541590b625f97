using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.References;
using LagSim.Scenes;
using LagSim.Time;
using MathNet.Numerics;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// An orbit around a centre, against Kepler's equation. On fixed steps the error is at most that of the classical method at that step; in
/// closed form and under error control at most the tolerance of each segment, passed on along the orbit.
/// </summary>
/// <remarks>
/// An error of dx in position and dv in velocity changes the energy by mu/r^2 dx + v dv, and so the mean motion: a time t later the body is
/// late by 3 a/mu of that times t, and is off by its motion in that time. All other errors come round with the orbit, magnified by 10/(1 -
/// e) at most.
/// </remarks>
internal sealed class KeplerCase : IHardCase
{
    private const double Step = 1.0 / 64;
    private const double Period = 8; // of laws without fixed steps
    private const int Places = 16; // samples of a period

    private static readonly double[] Slopes = [1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];

    public string Name => "kepler";

    public string Title => "one Kepler orbit from its far end, eccentricity 0 to 0.999, by every law";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double e, int steps) in Orbits(context))
        {
            KeplerOrbit orbit = new(e, steps * Step);
            (Vector3D[] seen, _) = Fly(context, orbit, HardFlight.Steps(Step), steps * Step);
            yield return StepRow(orbit, steps, seen);
        }

        foreach (double e in context.Sizes([0.5, 0.99], [0, 0.5, 0.9, 0.99, 0.999]))
        {
            KeplerOrbit orbit = new(e, Period);
            foreach (HardFlight flight in context.Sizes([0.0], [0, 1e-9]).Select(HardFlight.Closed).Concat(Tolerances(context, e).Select(HardFlight.Controlled)))
            {
                (Vector3D[] seen, Simulation simulation) = Fly(context, orbit, flight, Period);
                yield return PieceRow(orbit, flight, seen, Pieces(simulation));
            }
        }

        foreach (double e in context.Sizes([0.5], [0.0, 0.5, 0.9, 0.99, 0.999]))
        {
            KeplerOrbit orbit = new(e, Period);
            yield return SlopeRow(e, tolerance => WorstOf(orbit, Fly(context, orbit, HardFlight.Controlled(tolerance), Period).Seen, Period));
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach ((double e, int steps) in new[] { (0.0, 256), (0.5, 1024) })
        {
            KeplerOrbit orbit = new(e, steps * Step);
            yield return StepRow(orbit, steps, Textbook(orbit, ClassicalRungeKutta.ThesisStep, steps)) with { Note = "the thesis's update of the position" };
        }

        KeplerOrbit half = new(0.5, Period), heavier = new(0.5, Period * (1 - 1e-5));
        foreach (HardFlight flight in new[] { HardFlight.Closed(0), HardFlight.Controlled(1e-9) })
        {
            (Vector3D[] seen, Simulation simulation) = Fly(context, heavier, flight, Period);
            yield return PieceRow(half, flight, seen, Pieces(simulation)) with { Note = "a pull that is 2e-5 too strong" };
        }

        yield return SlopeRow(0.5, tolerance =>
        {
            int steps = (int)(128 * Math.Pow(tolerance / Slopes[0], -0.2)) / Places * Places;
            return WorstOf(half, Textbook(new KeplerOrbit(0.5, steps * Step), ClassicalRungeKutta.Midpoint, steps), Period);
        }) with
        { Note = "the midpoint method, with as many steps" };
    }

    private static (double E, int Steps)[] Orbits(HardContext context) =>
        context.Sizes([(0.0, 256), (0.5, 1024)], [(0.0, 256), (0.5, 1024), (0.9, 16_384), (0.99, 131_072), (0.999, 2_097_152)]);

    /// <summary>
    /// Near the centre of a narrow orbit, 1 - e away from it, an error of a micrometre a step would say nothing about where the body ends.
    /// </summary>
    private static double[] Tolerances(HardContext context, double e) => context.Sizes([1e-9], e <= 0.9 ? [1e-6, 1e-9, 1e-12] : [1e-9, 1e-12]);

    /// <summary>The sampled positions, the last of them after a period.</summary>
    private static (Vector3D[] Seen, Simulation Simulation) Fly(HardContext context, KeplerOrbit orbit, HardFlight flight, double period)
    {
        Scene scene = Floating("kepler").AddForce(orbit.Pull).AddBody("planet", flight.Ball(1e-6), orbit.Position(0), orbit.StartVelocity).Build();
        Simulation simulation = context.Simulate(scene, flight.Step > 0 ? null : SimDuration.MaxValue);
        Vector3D[] seen = new Vector3D[Places];
        for (int n = 0; n < Places; n++)
        {
            SimTime at = SimTime.FromSeconds(Instant(n, period));
            simulation.AdvanceTo(at);
            seen[n] = Read(simulation, First, at).Position;
            context.Report((n + 1.0) / Places);
        }

        return (seen, simulation);
    }

    private static (double Seconds, BodyState State)[] Pieces(Simulation simulation) =>
        [.. simulation.Timeline(First).Select(entry => (entry.Key.Time.ToSeconds(), entry.State))];

    private static double Instant(int place, double period) => (place + 1) * period / Places;

    private static Vector3D[] Textbook(KeplerOrbit orbit, ClassicalRungeKutta.Method method, int steps)
    {
        ClassicalRungeKutta.Acceleration pull = ClassicalRungeKutta.Of(orbit.Pull);
        Vector3D[] seen = new Vector3D[Places];
        (Vector3D x, Vector3D v) = (orbit.Position(0), orbit.StartVelocity);
        for (int n = 0; n < Places; n++)
        {
            (x, v) = ClassicalRungeKutta.Run(method, pull, x, v, Step, steps / Places);
            seen[n] = x;
        }

        return seen;
    }

    private static double WorstOf(KeplerOrbit orbit, Vector3D[] seen, double period) =>
        Worst(seen.Select((x, n) => (x - orbit.Position(Instant(n, period))).Length));

    private HardRow StepRow(KeplerOrbit orbit, int steps, Vector3D[] seen)
    {
        double own = WorstOf(orbit, Textbook(orbit, ClassicalRungeKutta.Step, steps), steps * Step);
        double rounding = 10 / (1 - orbit.E) * 40 * Rounding.Walk(steps);
        return new HardRow(
            Name, FormattableString.Invariant($"e {orbit.E}, {steps:N0} steps"), WorstOf(orbit, seen, steps * Step), "position_over_semi_major_axis",
            (1.01 * own)
                + rounding,
            "what the textbook's classical method leaves at this very step, written apart from the engine, and 1 % of it; a walk of 40 roundings a step, which the orbit magnifies by 10/(1 - e)",
            "Kepler's equation, at 16 instants of the orbit");
    }

    private HardRow PieceRow(KeplerOrbit orbit, HardFlight flight, Vector3D[] seen, (double Seconds, BodyState State)[] pieces)
    {
        double error = 0, bound = 0;
        for (int n = 0; n < Places; n++)
        {
            double t = Instant(n, Period), off = (seen[n] - orbit.Position(t)).Length;
            double allowed = Passed(orbit, flight, t, pieces);
            (error, bound) = !(off / allowed <= error / bound) ? (off, allowed) : (error, bound);
        }

        return new HardRow(
            Name, FormattableString.Invariant($"e {orbit.E}, {flight.Text}"), error, "position_at_the_worst_of_16_instants", bound,
            flight.Argument + ", four times their rms; passed on by the change of energy, 3 a/mu (mu/r^2 dx + v dv) t |v|, and 10/(1 - e) for all "
                + "that comes round with the orbit; 8 roundings of the reference's anomaly",
            "Kepler's equation, at 16 instants of the orbit")
        {
            Note = FormattableString.Invariant($"{pieces.Length} pieces"),
        };
    }

    /// <summary>Returns the errors of all segments up to a time, propagated to that time.</summary>
    private static double Passed(KeplerOrbit orbit, HardFlight flight, double t, (double Seconds, BodyState State)[] pieces)
    {
        double speed = orbit.SpeedAt(orbit.Position(t).Length), added = 0, squares = 0;
        double tolerance = flight.Law == MotionLaw.DormandPrince54 ? flight.Tolerance : 0;
        foreach ((double seconds, BodyState state) in pieces.TakeWhile(piece => piece.Seconds < t))
        {
            double r = state.Position.Length, v = state.Velocity.Length, rounding = HardFlight.RoundingsAPiece * Rounding.Walk(1);
            added += Now(tolerance, tolerance);
            squares += Math.Pow(Now(rounding * r, rounding * v), 2);

            double Now(double dx, double dv) =>
                (speed * 3 / orbit.Mu * ((orbit.Mu / (r * r) * dx) + (v * dv)) * (t - seconds)) + (10 / (1 - orbit.E) * (dx + (dv / orbit.Motion)));
        }

        return added + Math.Sqrt(squares) + (flight.Law == MotionLaw.ClosedForm ? flight.Tolerance : 0)
            + (8 * Rounding.Unit * 2 * Math.PI * speed / orbit.Motion);
    }

    private HardRow SlopeRow(double e, Func<double, double> worst)
    {
        double slope = Fit.Line([.. Slopes.Select(Math.Log10)], [.. Slopes.Select(tolerance => Math.Log10(worst(tolerance)))]).B;
        return new HardRow(
            Name, FormattableString.Invariant($"e {e}, Dormand-Prince, tolerances 1e-5 to 1e-10"), Math.Max(0, 1 - slope), "slope_below_1", 0.14,
            "an orbit's error is in proportion to the tolerance, or falls faster: estimates aim at 0.9^5 of the tolerance; between 0.3 of it and all, "
                + "0.26 decades either way, they turn the line by 0.14 at most",
            "error against tolerance, both logarithmic, least squares")
        {
            Note = FormattableString.Invariant($"measured slope {slope:0.000}"),
        };
    }
}
