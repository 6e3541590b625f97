using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>A ball in a box. After many hits it is where unfolding puts it, and back at the start when its velocity is reversed.</summary>
/// <remarks>
/// Flat walls neither magnify nor damp: an error in velocity after a hit moves the position by that times the remaining time, and no more.
/// In a box along the axes a hit reverses one component exactly. In a rotated box each hit rounds the velocity; its walls are not quite at
/// right angles then, which reversal undoes.
/// </remarks>
internal sealed class BoxReversalCase : IHardCase
{
    private const double Side = 1; // of the room for the centre
    private static readonly Vector3D Start = V(0.125, -0.25, 0.0625);
    private static readonly Vector3D Velocity = V(0.8125, 0.59375, 0.40625 + (1.0 / 1024)); // binary fractions, so that unfolding is exact

    public string Name => "box-reversal";

    public string Title => "a ball in a box, many hits, then its velocity reversed: unfolding, and back to the start";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (int hits in context.Sizes([10_000], [10_000, 1_000_000]))
        {
            (BodyState there, BodyState back, double seconds) = Run(context, hits, isTurned: false, 1);
            yield return UnfoldedRow(hits, there.Position, seconds);
            yield return BackRow(hits, back, isTurned: false, seconds);
            (_, back, seconds) = Run(context, hits, isTurned: true, 1);
            yield return BackRow(hits, back, isTurned: true, seconds);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const int hits = 1000;
        (BodyState there, BodyState back, double seconds) = Run(context, hits, isTurned: false, 1 - 1e-12);
        yield return UnfoldedRow(hits, there.Position, seconds) with { Note = "restitution 1 - 1e-12" };
        yield return BackRow(hits, back, isTurned: false, seconds) with { Note = "restitution 1 - 1e-12" };
        (_, back, seconds) = Run(context, hits, isTurned: true, 1 - 1e-12);
        yield return BackRow(hits, back, isTurned: true, seconds) with { Note = "restitution 1 - 1e-12" };
    }

    private static Vector3D Turn(in Vector3D v, bool isTurned) => isTurned
        ? V((0.6 * v.X) - (0.8 * v.Y), (0.48 * v.X) + (0.36 * v.Y) - (0.8 * v.Z), (0.64 * v.X) + (0.48 * v.Y) + (0.6 * v.Z))
        : v;

    private static (BodyState There, BodyState Back, double Seconds) Run(HardContext context, int hits, bool isTurned, double e)
    {
        SceneBuilder builder = Floating("box");
        foreach ((string name, Vector3D normal) in new[] { ("west", V(1)), ("east", V(-1)), ("floor", V(0, 1)), ("ceiling", V(0, -1)), ("south", V(0, 0, 1)),
            ("north", V(0, 0, -1)) })
        {
            builder.AddPlane(name, Turn(normal, isTurned), -(Side / 2) - 0.5);
        }

        Simulation simulation = context.Simulate(builder.AddBody("ball", Ball(e: e), Turn(Start, isTurned), Turn(Velocity, isTurned)).Build());
        double rate = (Velocity.X + Velocity.Y + Velocity.Z) / Side;
        SimTime turn = SimTime.FromSeconds(Math.Round(hits / rate)), end = turn + (turn - SimTime.Zero);
        Advance(simulation, turn, context, 0);
        BodyState there = Read(simulation, First, turn);
        simulation.Submit(ExternalEvent.SetVelocity(turn, 0, 1, First, -there.Velocity));
        Advance(simulation, end, context, 0.5);
        return (there, Read(simulation, First, end), turn.ToSeconds());
    }

    private static void Advance(Simulation simulation, SimTime to, HardContext context, double done)
    {
        SimTime from = simulation.SimulatedTo;
        for (int part = 1; part <= 20; part++)
        {
            simulation.AdvanceTo(from + ((to - from) / 20 * part));
            context.Report(done + (part / 40.0));
        }

        simulation.AdvanceTo(to);
    }

    private HardRow UnfoldedRow(int hits, Vector3D seen, double seconds) => new(
        Name, FormattableString.Invariant($"{hits:N0} hits, along the axes"),
        (seen - V(Fold(Start.X, Velocity.X, seconds), Fold(Start.Y, Velocity.Y, seconds), Fold(Start.Z, Velocity.Z, seconds))).Length, "position_m",
        4 * Side * Rounding.Unit * hits,
        "4 roundings of the place a hit, added; a hit turns a component round exactly", "unfolding, in decimal arithmetic");

    private HardRow BackRow(int hits, BodyState back, bool isTurned, double seconds)
    {
        double places = 4 * Side * Rounding.Unit * 2 * hits;
        double speeds = isTurned ? Velocity.Length * 2 * seconds * Rounding.Walk(2.0 * Rounding.PerContact * hits) / Math.Sqrt(3) : 0;
        return new HardRow(
            Name, FormattableString.Invariant($"{hits:N0} hits and back, {(isTurned ? "turned" : "along the axes")}"),
                (back.Position - Turn(Start, isTurned)).Length, "position_m",
            places + speeds,
            isTurned
                ? "4 roundings of the place a hit, added; the velocity walks by 8 roundings a hit, four times its rms, summed over the time: flat walls add,"
                    + " they do not multiply"
                : "4 roundings of the place a hit, added; a hit turns a component round exactly",
            "the start");
    }

    /// <summary>Returns the end of free flight, folded into the room.</summary>
    private static double Fold(double from, double speed, double seconds)
    {
        const decimal side = (decimal)Side;
        decimal way = ((decimal)from + ((decimal)speed * (decimal)seconds) + (side / 2)) % (2 * side);
        way = way < 0 ? way + (2 * side) : way;
        return (double)((way > side ? (2 * side) - way : way) - (side / 2));
    }
}
