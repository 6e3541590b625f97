using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Testing.Links;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Worlds far from the origin: the same events in the same order, and the cost of the coarser positions.</summary>
internal sealed class FarCase : IHardCase
{
    private const int Compared = 30;

    private static readonly double FirstImpact = Math.Sqrt(2 / Gravity);

    public string Name => "far";

    public string Title => "coordinates of 1e3 to 1e9 m: the same events in the same order, and the loss of time";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double offset in context.Sizes([1e6], [1e3, 1e6, 1e9]))
        {
            yield return BounceRow(offset, Bounce(context, offset, Gravity));
        }

        foreach (double offset in context.Sizes([1e6], [1e3, 1e5, 1e6]))
        {
            yield return OrderRow(context, offset, 0);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return BounceRow(1e3, Bounce(context, 1e3, Gravity * (1 + 1e-9))) with { Note = "gravity off by 1e-9" };
        yield return OrderRow(context, 1e6, 0.1) with { Note = "one ball a decimetre further on" };
    }

    private static double[] Bounce(HardContext context, double at, double gravity)
    {
        Scene scene = new SceneBuilder("far").WithGravity(V(0, -gravity)).AddPlane("floor", Vector3D.Up, V(0, at)).AddBody("ball", Ball(),
            V(at, at + 1.5, -at), V(3, 0, 1)).Build();
        return ImpactTimes(context.Run(scene, 100), First);
    }

    private HardRow BounceRow(double offset, double[] seen)
    {
        double speed = Gravity * FirstImpact, place = 4 * Rounding.Unit * (offset + 1.5);
        double worst = Worst(seen.Select((t, n) => Math.Abs(t - (((2 * n) + 1) * FirstImpact))));
        double n = seen.Length;
        return new HardRow(
            Name, FormattableString.Invariant($"{n} bounces at {offset:N0} m"), n > 100 ? worst : double.NaN, "time_s",
            Rounding.Tick + (n * n * ((place / speed) + (Rounding.PerContact * Rounding.Unit * FirstImpact))),
            "4 roundings of the place a contact change the speed by g/v of them, and that every later hop: n^2 (place/v + 8 u t1), and a tick",
                "t_n = (2n - 1) t1");
    }

    private HardRow OrderRow(HardContext context, double offset, double nudge)
    {
        EventKey[] near = Story(context, 0, 0), far = Story(context, offset, nudge);
        int same = near.Zip(far).TakeWhile(pair => pair.First.Body == pair.Second.Body && pair.First.Other == pair.Second.Other).Count();
        double late = near.Zip(far).Take(same).Select(pair => Math.Abs(pair.First.Time.ToSeconds() - pair.Second.Time.ToSeconds())).DefaultIfEmpty(0).Max();
        double closest = near.Zip(near.Skip(1), (a, b) => b.Time.ToSeconds() - a.Time.ToSeconds()).Min();
        return new HardRow(
            Name, FormattableString.Invariant($"5 balls, {Compared} impacts at {offset:N0} m"), near.Length == Compared ? Compared - same : double.NaN,
                "events_out_of_order", 0,
            "an order is right or wrong; it is decided as long as the loss of time is less than what two impacts are apart", "the same scene at the origin")
        {
            Note = FormattableString.Invariant($"times off by up to {late:0.0e0} s, two impacts at least {closest:0.0e0} s apart"),
        };
    }

    private static EventKey[] Story(HardContext context, double offset, double nudge)
    {
        SeededRandom random = new(11);
        SceneBuilder builder = new SceneBuilder("cluster").AddPlane("floor", Vector3D.Up, V(offset, offset, offset), 0.9)
            .AddPlane("left", V(1), V(offset - 3)).AddPlane("right", V(-1), V(offset + 3));
        for (int n = 0; n < 5; n++)
        {
            Vector3D place = V(offset - 2.25 + n + (n == 2 ? nudge : 0), offset + 1 + (Math.Floor(random.NextDouble() * 65536) / 65536), offset);
            builder.AddBody($"ball {n}", Ball(0.25, 1 + n), place, V(Math.Floor(random.NextDouble(-8, 8)) / 4, 0, 0));
        }

        Simulation simulation = context.Run(builder.Build(), 3);
        return Enumerable.Range(0, 5).SelectMany(n => Impacts(simulation, BodyId.OfScene(n))).Select(entry => entry.Key).Distinct().Order().Take(Compared)
            .ToArray();
    }
}
