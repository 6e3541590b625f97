using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Ten micrometres at a thousand kilometres a second: nothing tunnels at any frame rate.</summary>
internal sealed class SmallFastCase : IHardCase
{
    private const double Radius = 1e-5;
    private const double Speed = 1e6;
    private const double Apart = 2.375;

    public string Name => "small-fast";

    public string Title => "radius 1e-5 m at 1e6 m/s: head-on, and between a wall and a post, at any frame rate";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (MotionLaw law in new[] { MotionLaw.Ballistic, MotionLaw.RungeKutta4 })
        {
            foreach (int frames in new[] { 1, 7, 1000 })
            {
                yield return MeetRow(FormattableString.Invariant($"head-on, {law}, {frames} frames in 3 us"), HeadOn(context, law, frames));
            }

            double seconds = law == MotionLaw.Ballistic ? context.Size(1e-4, 1e-2) : 1e-4;
            yield return RattleRow(law, seconds, Rattle(context, law, seconds));
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // Sampling once a microsecond sees the two apart and then on the wrong sides, never touching.
        double[] met = Enumerable.Range(0, 4).Select(n => n * 1e-6).Where(t => Math.Abs(Apart - (2 * Speed * t)) < 2 * Radius).ToArray();
        yield return MeetRow("head-on", met) with { Note = "looked at once a microsecond" };
        yield return RattleRow(MotionLaw.Ballistic, 1e-4, 0) with { Note = "looked at once a microsecond" };
    }

    private static BodySpec Bullet(MotionLaw law) => new(Radius, 1, 1, law, SimDuration.FromSeconds(law == MotionLaw.Ballistic ? 0.01 : 1e-6));

    private static double[] HeadOn(HardContext context, MotionLaw law, int frames)
    {
        Scene scene = Floating("bullets").AddBody("left", Bullet(law), V(-1), V(Speed)).AddBody("right", Bullet(law), V(Apart - 1), V(-Speed)).Build();
        return ImpactTimes(InFrames(context, scene, 3e-6, frames), First);
    }

    private static long Rattle(HardContext context, MotionLaw law, double seconds)
    {
        // A metre between the two surfaces: a million bounces a second.
        Scene scene = Floating("rattle").AddPlane("wall", V(1), V(0)).AddStaticSphere("post", V(1 + 1e-4), 1e-4).AddBody("bullet", Bullet(law), V(0.3),
            V(Speed)).Build();
        return InFrames(context, scene, seconds, 13).ImpactsProcessed;
    }

    private static Simulation InFrames(HardContext context, Scene scene, double seconds, int frames)
    {
        Simulation simulation = context.Simulate(scene, SimDuration.MaxValue);
        for (int n = 1; n <= frames; n++)
        {
            simulation.AdvanceTo(SimTime.FromSeconds(seconds * n / frames));
        }

        return simulation;
    }

    private HardRow MeetRow(string size, double[] impacts)
    {
        double expected = (Apart - (2 * Radius)) / (2 * Speed);
        return new HardRow(
            Name, size, impacts.Length == 1 ? Math.Abs(impacts[0] - expected) : double.NaN, "time_s", Rounding.Tick
                + (16 * Rounding.Unit * Apart / (2 * Speed)),
            "a tick, and 16 roundings of the place over the speed; no impact or several is no number and fails", "distance over speed");
    }

    private HardRow RattleRow(MotionLaw law, double seconds, long seen)
    {
        double lap = 1 - (2 * Radius);
        long expected = (long)Math.Floor(((seconds * Speed) - (1 - Radius - 0.3)) / lap) + 1;
        return new HardRow(
            Name, FormattableString.Invariant($"between wall and post, {law}, {expected:N0} hits"), Math.Abs(seen - expected), "count", 0,
            "the last hit is further from the end than all ticks and roundings add up to", "distance over speed");
    }
}
