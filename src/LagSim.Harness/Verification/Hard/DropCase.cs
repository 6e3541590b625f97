using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>A dropped ball with restitution, against the closed form of all its bounces and of their end (Zeno).</summary>
internal sealed class DropCase : IHardCase
{
    private const double Height = 1;
    private const double Radius = 0.5;
    private const double Step = 1.0 / 256;

    private static readonly double FirstImpact = Math.Sqrt(2 * Height / Gravity);

    public string Name => "drop";

    public string Title => "a ball dropped 1 m with restitution e: the time of every bounce, and of the rest that ends them (Zeno)";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double e in context.Sizes([0.5, 0.8], [0.2, 0.5, 0.8, 0.9, 0.99, 0.999]))
        {
            yield return Row(Times(context, MotionLaw.Ballistic, e), e, MotionLaw.Ballistic);
        }

        foreach (double e in context.Sizes([0.5], [0.5, 0.8, 0.99]))
        {
            yield return Row(Times(context, MotionLaw.RungeKutta4, e), e, MotionLaw.RungeKutta4);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        (double[] times, double rest) = Times(context, MotionLaw.Ballistic, 0.8 - 1e-9);
        yield return Row((times, rest), 0.8, MotionLaw.Ballistic) with { Note = "restitution off by 1e-9" };
        yield return Row((times.Select(t => Math.Ceiling(t * 1e6) / 1e6).ToArray(), rest), 0.8,
            MotionLaw.Ballistic) with
        { Note = "impacts at the next microsecond" };
        yield return Row((Times(context, MotionLaw.Ballistic, 0.8).Impacts, double.NaN), 0.8, MotionLaw.Ballistic) with { Note = "no rest" };
    }

    private static (double[] Impacts, double Resting) Times(HardContext context, MotionLaw law, double e)
    {
        double limit = FirstImpact * (1 + e) / (1 - e);
        Scene scene = new SceneBuilder("drop").AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", new BodySpec(Radius, 1, e, law, SimDuration.FromSeconds(Step)), V(0, Height + Radius)).Build();
        Simulation simulation = context.Run(scene, limit + 1);
        LagSim.Timelines.TimelineEntry last = simulation.Timeline(First)[^1];
        return (ImpactTimes(simulation, First), last.State.Motion == MotionLaw.Resting ? last.Key.Time.ToSeconds() : double.NaN);
    }

    private HardRow Row((double[] Impacts, double Resting) seen, double e, MotionLaw law)
    {
        double speed = Gravity * FirstImpact; // before the first impact
        double expected = FirstImpact, worst = 0, roundings = 0;
        double steps = law == MotionLaw.Ballistic ? 0 : 1 / Step; // per second; each of them rounds the position
        for (int n = 1; n <= seen.Impacts.Length; n++)
        {
            worst = Math.Max(worst, Math.Abs(seen.Impacts[n - 1] - expected));
            speed *= e;
            double hop = 2 * speed / Gravity;
            expected += hop;

            // An error of d in position moves the impact by d/v in time, and changes the speed by g d/v. A relative error of the speed
            // makes all following bounces, 2v/(g (1 - e)), longer by that fraction.
            double place = (4 + (steps * hop)) * Rounding.Unit * Radius, toCome = 2 * speed / (Gravity * (1 - e));
            roundings += (place / speed) + (((Gravity * place / (speed * speed)) + (Rounding.PerContact * Rounding.Unit)) * toCome);
        }

        double limit = FirstImpact * (1 + e) / (1 - e);
        double error = double.IsNaN(seen.Resting) || seen.Impacts.Length < 5 ? double.NaN : Math.Max(worst, Math.Abs(seen.Resting - limit));
        return new HardRow(
            Name, FormattableString.Invariant($"e {e}, {seen.Impacts.Length} bounces, {law}"), error, "time_s", Rounding.Tick + roundings,
            "a tick; d/v of each contact, d being 4 roundings of the place (and one a step); and of all hops after it the part by which its speed is off, g d/v^2 and 8 roundings; all added",
            "t_n = t1 + (2 v1/g) e (1 - e^(n-1))/(1 - e), limit t1 (1 + e)/(1 - e)");
    }
}
