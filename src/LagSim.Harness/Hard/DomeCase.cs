using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>A ball slides off a dome, which carries it until the dome would have to pull: lasting contact on what is round, and its end.</summary>
internal sealed class DomeCase : IHardCase
{
    private const double Reach = 2; // of the dome's radius and the ball's
    private const double Step = 1.0 / 512;

    public string Name => "dome";

    public string Title => "a ball slides off a dome without friction: it leaves where two thirds of the height are left, with the energy that it began with";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double start in context.Sizes([0.1], [0.01, 0.1, 0.5]))
        {
            Simulation simulation = context.Run(Scene(start), Length(start));
            TimelineEntry[] path = [.. simulation.Timeline(First)];
            TimelineEntry left = path.First(entry => entry.Key.Time > SimTime.Zero && entry.State.Motion == MotionLaw.Ballistic);
            double worst = path.Where(entry => entry.State.Motion == MotionLaw.Constrained)
                .Max(entry => Math.Abs(Energy(entry.State) - (Gravity * Reach * Math.Cos(start))));
            double off = path.Where(entry => entry.State.Motion == MotionLaw.Constrained).Max(entry => Math.Abs(entry.State.Position.Length - Reach));
            foreach (HardRow row in Rows(start, Angle(left.State.Position), worst, off))
            {
                yield return row;
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // Steps that move on and are then put back onto the dome, with what is left of the velocity along it: of the first order.
        double angle = 0.1, v = 0, worst = 0, off = 0;
        (double X, double Y) p = (Reach * Math.Sin(angle), Reach * Math.Cos(angle));
        double start = Gravity * p.Y;
        while (v * v < Gravity * p.Y)
        {
            (double X, double Y) t = (p.Y / Reach, -p.X / Reach);
            v += Gravity * -t.Y * Step;
            p = (p.X + (v * t.X * Step), p.Y + (v * t.Y * Step));
            double length = Math.Sqrt((p.X * p.X) + (p.Y * p.Y));
            off = Math.Max(off, Math.Abs(length - Reach));
            p = (p.X * Reach / length, p.Y * Reach / length);
            worst = Math.Max(worst, Math.Abs((0.5 * v * v) + (Gravity * p.Y) - start));
        }

        foreach (HardRow row in Rows(0.1, Math.Atan2(p.X, p.Y) + 0.05, worst, off))
        {
            yield return row with { Note = "put back onto the dome after each step, and leaves it 0.05 rad late" };
        }
    }

    private static Scene Scene(double angle) => new SceneBuilder("dome").AddStaticSphere("dome", V(0), Reach - 0.5, 0)
        .AddBody("ball", Ball(e: 0), V(Reach * Math.Sin(angle), Reach * Math.Cos(angle))).Build();

    // From the angle at which it begins it takes some ln(1/angle) times sqrt(R/g); by then it has fallen off.
    private static double Length(double angle) => (Math.Log(10 / angle) + 1) * Math.Sqrt(Reach / Gravity);

    private static double Angle(Vector3D position) => Math.Atan2(position.X, position.Y);

    private static double Energy(BodyState state) => (0.5 * state.Velocity.LengthSquared) + (Gravity * state.Position.Y);

    private IEnumerable<HardRow> Rows(double start, double angle, double energy, double off)
    {
        double leaves = Math.Acos(2.0 / 3 * Math.Cos(start));
        double rate = Math.Sqrt(2.0 / 3 * Gravity * Math.Cos(start) / Reach); // rad/s there
        string size = FormattableString.Invariant($"let go {start} rad from the top");
        yield return new HardRow(
            Name, size, Math.Abs(angle - leaves), "angle_rad", 2 * Step * rate,
            "the way of two steps of 1/512 s: it leaves at the end of one in which the dome has pushed last",
            "cos = 2/3 of the cosine at which it began");
        double change = Step * rate;
        yield return new HardRow(
            Name, size, energy / (Gravity * Reach), "energy_relative", change * change, "second order: the square of the angle of a step",
            "the energy at the start");
        yield return new HardRow(
            Name, size, off, "distance_m", 1000 * SceneBuilder.DefaultResolution,
            "a thousand resolutions, within which a contact lasts; no drift is added from step to step", "the sum of the radii");
    }
}
