using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Several contacts at one instant. The answer must be symmetric, and the same for any order of the bodies.</summary>
internal sealed class SimultaneousCase : IHardCase
{
    /// <summary>The relative error allowed for two contacts solved together: twice that of one.</summary>
    private const double Together = 2 * Rounding.PerContact * Rounding.Unit;

    public string Name => "simultaneous";

    public string Title => "three balls and more at one instant: symmetric, and independent of the order of the bodies";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        yield return BreakRow(Break(context, 0));
        foreach (double mass in new[] { 1, 5, 1e12, 1e-12 })
        {
            yield return MiddleRow(context, mass, 0);
        }

        yield return OrderRow(context, 0);
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return BreakRow(Break(context, 1e-9)) with { Note = "one ball a nanometre further off, so one after the other" };
        yield return MiddleRow(context, 5, 1e-6) with { Note = "one side a micrometre further off" };
        yield return OrderRow(context, 1e-6) with { Note = "one mass other by 1e-6" };
    }

    private static Vector3D[] Break(HardContext context, double off)
    {
        Scene scene = Floating("break").AddBody("cue", Ball(), V(-3), V(2)).AddBody("left", Ball(), V(0, 0, -0.5)).AddBody("right", Ball(),
            V(off, 0, 0.5)).Build();
        Simulation simulation = context.Run(scene, 3);
        return Enumerable.Range(0, 3).Select(n => Read(simulation, n, 3).Velocity).ToArray();
    }

    private HardRow BreakRow(Vector3D[] v)
    {
        // Momentum and energy with both contacts elastic: the cue comes back with a fifth, the two leave at 30 degrees with 2 sqrt(3)/5.
        double across = 2 * 0.4 * Math.Sqrt(3) * 0.5;
        Vector3D[] expected = [V(-0.4), V(1.2, 0, -across), V(1.2, 0, across)];
        return new HardRow(
            Name, "break: one into two that touch", Worst(v.Zip(expected, (a, b) => (a - b).Length)), "speed_m_per_s", 2 * Together,
            "16 roundings of 2 m/s, two contacts that are solved together", "-1/5 and 3/5 of the cue's speed, symmetric");
    }

    private HardRow MiddleRow(HardContext context, double mass, double off)
    {
        Scene scene = Floating("middle").AddBody("left", Ball(), V(-3), V(1)).AddBody("middle", Ball(mass: mass), default).AddBody("right", Ball(), V(3 + off),
            V(-1)).Build();
        Simulation simulation = context.Run(scene, 5);
        double[] v = Enumerable.Range(0, 3).Select(n => Read(simulation, n, 5).Velocity.X).ToArray();
        return new HardRow(
            Name, $"hit from both sides, middle {NumberText.Short(mass)} kg", Worst([Math.Abs(v[0] + 1), Math.Abs(v[1]), Math.Abs(v[2] - 1)]),
                "speed_m_per_s",
            Together * Math.Max(1, 1 / Math.Sqrt(mass)),
            "16 roundings, and for a light middle the root of the mass ratio times that: the solver's rows are weighed by the roots of masses",
                "the middle stays, the others turn round");
    }

    private HardRow OrderRow(HardContext context, double off)
    {
        Vector3D[] expected = Five(context, [0, 1, 2, 3, 4], 0, out int impacts);
        double worst = new int[][] { [4, 3, 2, 1, 0], [1, 0, 2, 4, 3], [2, 4, 0, 3, 1], [3, 1, 4, 0, 2] }
            .Max(order => Worst(Five(context, order, off, out _).Zip(expected, (a, b) => (a - b).Length)));
        return new HardRow(
            Name, FormattableString.Invariant($"five balls in 5 orders, {impacts} impacts"), worst, "speed_m_per_s",
                Together * 7 * Math.Pow(1 + (2 * 2 / 0.5), impacts - 1),
            "16 roundings of 7 m/s, magnified by each further impact by 1 + 2 l/r, the flight l of 2 m and the radius r",
                "the same bodies named in another order");
    }

    private static Vector3D[] Five(HardContext context, int[] order, double off, out int impacts)
    {
        (double Mass, Vector3D X, Vector3D V)[] balls =
        [
            (1 + off, V(-3), V(2)), (3, V(0, 0, -0.5), V(0)), (1.5, V(0, 0, 0.5), V(0)), (0.25, V(0.9, 0.1), V(0)), (7, V(0, 5), V(0, -2)),
        ];
        SceneBuilder builder = Floating("permuted");
        foreach (int n in order)
        {
            builder.AddBody($"ball {n}", Ball(mass: balls[n].Mass), balls[n].X, balls[n].V);
        }

        Simulation simulation = context.Run(builder.Build(), 3);
        impacts = (int)simulation.ImpactsProcessed;
        return Enumerable.Range(0, balls.Length).Select(n => Read(simulation, simulation.Scene.BodyNamed($"ball {n}"), SimTime.FromSeconds(3)).Velocity)
            .ToArray();
    }
}
