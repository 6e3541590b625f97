using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Contacts that barely happen or barely miss: grazing spheres, and a ceiling at the apex.</summary>
internal sealed class GrazeCase : IHardCase
{
    public string Name => "graze";

    public string Title => "grazing spheres, and a ceiling at the apex: every hit found, every miss missed, touching does not hang";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (MotionLaw law in new[] { MotionLaw.Ballistic, MotionLaw.RungeKutta4 })
        {
            yield return Row("spheres", law, (off, isHit) => Passes(context, law, off) == isHit);
            yield return Row("ceiling", law, (off, isHit) => Reaches(context, law, off) == isHit);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        // Sampling distances once a millisecond, at any phase, misses a shorter touch.
        yield return Row("spheres", MotionLaw.Ballistic, (off, isHit) =>
            Enumerable.Range(0, 3000).Any(n => new Vector3D(-3 + (2 * ((n + 0.5) / 1000)), 1 + off, 0).Length < 1) == isHit) with
        { Note = "looked at once a millisecond" };
        yield return Row("ceiling", MotionLaw.Ballistic, (off, isHit) =>
            Reaches(context, MotionLaw.Ballistic, off - 1e-9) == isHit) with
        { Note = "a ceiling a nanometre too low" };
    }

    private static bool Passes(HardContext context, MotionLaw law, double off)
    {
        BodySpec ball = new(0.5, 1, 1, law, SimDuration.FromSeconds(1.0 / 128));
        return Happens(context, Floating("graze").AddBody("still", ball, default).AddBody("passing", ball, V(-3, 1 + off), V(2)).Build());
    }

    private static bool Reaches(HardContext context, MotionLaw law, double off)
    {
        // At 10 m/s under 10 m/s^2 the apex is at 5 m.
        BodySpec ball = new(0.5, 1, 1, law, SimDuration.FromSeconds(1.0 / 128));
        return Happens(context, new SceneBuilder("apex").WithGravity(V(0, -10)).AddPlane("ceiling", V(0, -1), V(0, 5.5 + off)).AddBody("ball", ball, default,
            V(0, 10)).Build());
    }

    private static bool Happens(HardContext context, Scene scene)
    {
        Simulation simulation = context.Simulate(scene);
        simulation.AdvanceTo(SimTime.FromSeconds(2.5));
        return simulation.ImpactsProcessed switch
        {
            0 => false,
            1 => true,
            _ => throw new InvalidOperationException($"{simulation.ImpactsProcessed} impacts where there is one at most."),
        };
    }

    /// <summary>Deeper and shallower by 1e-2 m down to where rounding decides, and exactly touching, which is no contact.</summary>
    private HardRow Row(string what, MotionLaw law, Func<double, bool, bool> isRight)
    {
        // A position of some metres after 16 roundings cannot resolve less than this; of steps each counts.
        double finest = law == MotionLaw.Ballistic ? 1e-14 : 1e-12;
        List<double> wrong = isRight(0, false) ? [] : [0];
        int asked = 1;
        for (double off = 1e-2; off > 0.9 * finest; off /= 10)
        {
            wrong.AddRange(new[] { off, -off }.Where(o => !isRight(o, o < 0)));
            asked += 2;
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{what}, {law}, off by 0 and 1e-2 to {finest:0e0} m, {asked} tries"), wrong.Count, "wrong", 0,
            "each is further off than 16 roundings (of every step, with Runge-Kutta) of a place of 5 m, so none may be wrong; exactly touching is no contact",
                "the sign of how far it is off")
        {
            Note = wrong.Count == 0 ? "" : "wrong when off by " + string.Join(", ", wrong.Select(off => FormattableString.Invariant($"{off:0e0} m"))),
        };
    }
}
