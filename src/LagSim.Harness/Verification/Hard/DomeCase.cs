using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A ball slides off a dome, which carries it until the dome would have to pull: persistent contact on a round surface, and its end.
/// </summary>
/// <remarks>
/// In steps of h the ball moves on chords, which lead away from the dome by (v h)^2/(2 R) at most. It is released once it is d/4 off the
/// dome. Where the dome ceases to push, the gap grows as g sin(a) w t^3/2, with w the angular velocity, so the release is (d/(2 g sin(a)
/// w))^(1/3) later, on a path that is free by then. All other errors are of the second order at ticks, where velocities are the means of
/// both sides.
/// </remarks>
internal sealed class DomeCase : IHardCase
{
    private const double Reach = 2; // of the dome's radius and the ball's
    private const double Flight = 0.2; // s after the release

    public string Name => "dome";

    public string Title => "a ball slides off a dome without friction: it leaves where two thirds of the height are left, with the energy that it began with";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double start in context.Sizes([0.1], [0.01, 0.1, 0.5]))
        {
            foreach (double d in context.Sizes([1e-5], [1e-3, 1e-5, 1e-7]))
            {
                foreach (HardRow row in Rows(start, d, Errors(context, start, d, ContactSteps.Step(d))))
                {
                    yield return row;
                }
            }

            Seen coarse = Errors(context, start, ContactSteps.ToleranceOf(Coarse), Coarse),
                fine = Errors(context, start, ContactSteps.ToleranceOf(Fine), Fine);
            foreach (HardRow row in Orders(start, coarse, fine, Coarse / Fine))
            {
                yield return row;
            }
        }
    }

    private const double Coarse = 1.0 / 256, Fine = 1.0 / 4096;

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        Seen same = Errors(context, 0.1, ContactSteps.ToleranceOf(Coarse), Coarse);
        foreach (HardRow row in Orders(0.1, same, same, Coarse / Fine))
        {
            yield return row with { Note = ContactSteps.SameSteps };
        }

        Seen wrong = Tangents(ContactSteps.Step(1e-5));
        foreach (HardRow row in Rows(0.1, 1e-5, wrong))
        {
            yield return row with { Note = "goes on along the tangent and is never put back onto the dome, and leaves it 0.05 rad late" };
        }

        foreach (HardRow row in Orders(0.1, Tangents(1.0 / 256), Tangents(1.0 / 4096), 16)
            .Where(row => !row.Size.Contains("within", StringComparison.Ordinal)))
        {
            yield return row with { Note = "goes on along the tangent and is never put back onto the dome, and leaves it 0.05 rad late" };
        }
    }

    private static Seen Errors(HardContext context, double start, double d, double step)
    {
        Simulation simulation = context.Run(Scene(start, d), Length(start));
        TimelineEntry[] path = [.. simulation.Timeline(First)];
        TimelineEntry[] steps = [.. path
            .Where(entry => entry.State.Motion == MotionLaw.Constrained && entry.Key.Kind == EventKind.StepEnd)];
        TimelineEntry left = path.First(entry => entry.Key.Time > SimTime.Zero && entry.State.Motion == MotionLaw.Ballistic);
        double let = left.Key.Time.ToSeconds(), early = ContactSteps.TickBefore(0.7 * let, step), full = Gravity * Reach * Math.Cos(start);
        return new Seen(
            Angle(left.State.Position) - Leaves(start),
            steps.Skip(1)
                .Max(entry => Math.Abs(Energy(ContactSteps.AtTick(simulation, 0, entry.Key.Time.ToSeconds(), step)) - full))
                    / (Gravity * Reach),
            steps.Max(entry => Math.Abs(Energy(entry.State) - full)) / (Gravity * Reach),
            steps.Max(entry => Math.Abs(entry.State.Position.Length - Reach)),
            (Read(simulation, 0, early).Position - Exact(start, early)).Length,
            (Read(simulation, 0, let + Flight).Position - Exact(start, SimTime.FromSeconds(let + Flight).ToSeconds())).Length);
    }

    /// <summary>A wrong method: of the first order, without anything that keeps the ball on the dome.</summary>
    private static Seen Tangents(double step)
    {
        double angle = 0.1, v = 0, worst = 0, off = 0, t = 0, place = 0;
        (double X, double Y) p = (Reach * Math.Sin(angle), Reach * Math.Cos(angle));
        double start = Gravity * p.Y;
        while (v * v < Gravity * p.Y)
        {
            double length = Math.Sqrt((p.X * p.X) + (p.Y * p.Y));
            (double X, double Y) tangent = (p.Y / length, -p.X / length);
            v += Gravity * -tangent.Y * step;
            p = (p.X + (v * tangent.X * step), p.Y + (v * tangent.Y * step));
            t += step;
            off = Math.Max(off, Math.Abs(Math.Sqrt((p.X * p.X) + (p.Y * p.Y)) - Reach));
            worst = Math.Max(worst, Math.Abs((0.5 * v * v) + (Gravity * p.Y) - start) / (Gravity * Reach));
            place = t < 1 ? (V(p.X, p.Y) - Exact(0.1, t)).Length : place;
        }

        return new Seen(Math.Atan2(p.X, p.Y) + 0.05 - Leaves(0.1), worst, 10 * worst, off, place, place);
    }

    /// <summary>
    /// Returns the exact position of the ball: by 20,000 classical Runge-Kutta steps on the dome, and on a parabola from where the dome
    /// would have to pull.
    /// </summary>
    private static Vector3D Exact(double start, double seconds)
    {
        const int Steps = 20_000;
        double a = start, w = 0, h = seconds / Steps;
        for (int n = 0; n < Steps; n++)
        {
            if (w * w * Reach >= Gravity * Math.Cos(a))
            {
                double flies = (Steps - n) * h;
                return OnDome(a) + (V(Math.Cos(a), -Math.Sin(a)) * (w * Reach * flies)) - V(0, Gravity * flies * flies / 2);
            }

            double k1 = w, l1 = Pull(a), k2 = w + (h / 2 * l1), l2 = Pull(a + (h / 2 * k1));
            double k3 = w + (h / 2 * l2), l3 = Pull(a + (h / 2 * k2)), k4 = w + (h * l3), l4 = Pull(a + (h * k3));
            a += h / 6 * (k1 + (2 * k2) + (2 * k3) + k4);
            w += h / 6 * (l1 + (2 * l2) + (2 * l3) + l4);
        }

        return OnDome(a);

        static double Pull(double angle) => Gravity / Reach * Math.Sin(angle);
    }

    private static Vector3D OnDome(double angle) => V(Reach * Math.Sin(angle), Reach * Math.Cos(angle));

    private static double Leaves(double start) => Math.Acos(2.0 / 3 * Math.Cos(start));

    private static Scene Scene(double angle, double d) =>
        new SceneBuilder("dome").WithContactTolerance(d).AddStaticSphere("dome", V(0), Reach - 0.5, 0)
        .AddBody("ball", Ball(e: 0), OnDome(angle)).Build();

    // From its starting angle it takes some ln(1/angle) times sqrt(R/g); by then it has fallen off.
    private static double Length(double angle) => (Math.Log(10 / angle) + 1) * Math.Sqrt(Reach / Gravity);

    private static double Angle(Vector3D position) => Math.Atan2(position.X, position.Y);

    private static double Energy(BodyState state) => (0.5 * state.Velocity.LengthSquared) + (Gravity * state.Position.Y);

    private IEnumerable<HardRow> Rows(double start, double d, Seen seen)
    {
        double leaves = Leaves(start), rate = Math.Sqrt(2.0 / 3 * Gravity * Math.Cos(start) / Reach); // rad/s there
        double step = ContactSteps.Step(d), turn = rate * step, growth = Math.Sqrt(Gravity / Reach);
        double late = Math.Pow(d / (2 * Gravity * Math.Sin(leaves) * rate), 1.0 / 3);
        string size = FormattableString.Invariant($"let go {start} rad from the top, d {d} m");
        yield return new HardRow(
            Name, size, Math.Abs(seen.Angle), "angle_rad", rate * (late + (2 * step)),
            "the way until it is d/4 off where nothing holds it, (d/(2 g sin(a) w))^(1/3) s, and of two steps: it is let go at the end of"
                + " one in which the dome pushed last",
            "cos = 2/3 of the cosine at which it began");
        yield return new HardRow(
            Name, size, seen.AtTicks, "energy_at_ticks_relative", 13.0 / 12 * turn * turn,
            "second order in the angle of a step, w h: half its square for the height that a chord leads away, as much for what pushes"
                + " meanwhile, a twelfth for the mean of two velocities",
            "the energy at the start");
        yield return new HardRow(
            Name, size, seen.Within, "energy_within_steps_relative", (0.5 * turn) + (13.0 / 12 * turn * turn),
            "v a h/2 more: within a step the velocity is that of its middle", "the energy at the start");
        double off = (turn * turn * Reach / 2) + (0.25 * d) + (ContactSteps.Closing / 2 * d);
        yield return new HardRow(
            Name, size, seen.Off, "distance_m", off,
            "a chord leads away by (v h)^2/(2 R), it is let go d/4 off, and 0.05 d is what a step may leave; no drift is added from step to"
                + " step", "the sum of the radii");
        double place = off + (Reach * leaves * growth * Length(start) * growth * step * growth * step / 24);
        yield return new HardRow(
            Name, size, seen.Place, "place_m", place,
            "that, and the (W h)^2/24 by which leapfrog's rate of leaving the top is off, W being the root of g/R, for as long as it"
                + " takes", "20,000 Runge-Kutta steps");
        yield return new HardRow(
            Name, size, seen.Flown, "place_in_flight_m",
                place + (0.25 * d) + (Flight * ((growth * place) + (rate * Reach * turn * turn / 8))),
            "that, d/4, and for 0.2 s the speeds that go with it: W times the place, and an eighth of the square of w h", "20,000"
                + " Runge-Kutta steps and a parabola");
    }

    private IEnumerable<HardRow> Orders(double start, Seen coarse, Seen fine, double ratio)
    {
        string size = FormattableString.Invariant($"let go {start} rad from the top, ");
        yield return ContactSteps.Order(
            Name, size + "angle", Math.Abs(coarse.Angle), Math.Abs(fine.Angle), ratio, 2.0 / 3, 0.1,
            "the cube root of d; that it is let go at ticks adds up to a step, a quarter of it at the coarser d, over ln 16");
        const string Next = "the next order is a few w h, below a hundredth, of this one";
        yield return ContactSteps.Order(Name, size + "energy at ticks", coarse.AtTicks, fine.AtTicks, ratio, 2, 0.05, Next);
        yield return ContactSteps.Order(Name, size + "energy within steps", coarse.Within, fine.Within, ratio, 1, 0.05, Next);
        yield return ContactSteps.Order(Name, size + "place", coarse.Place, fine.Place, ratio, 2, 0.05, Next);
    }

    private readonly record struct Seen(double Angle, double AtTicks, double Within, double Off, double Place, double Flown);
}
