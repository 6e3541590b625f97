using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Impacts of spheres with friction and spin: a bounce that grips or slips, a ball that backspin brings back, and one between floor and
/// ceiling. Energy must never grow.
/// </summary>
/// <remarks>
/// A solid sphere has slip u = v + r w on a floor, and a normal velocity n. It grips, and leaves with no slip and v - 2/7 u, if that is
/// within the limit of friction, mu (1 + e) n; else v changes by the limit, and r w by 5/2 of it (Garwin 1969, with a tangential
/// restitution of zero: nothing here springs back along the surface, as a super ball does).
/// </remarks>
internal sealed class ObliqueCase : IHardCase
{
    private const double Radius = 0.5;
    private const double E = 0.8;
    private const double Down = 5;

    public string Name => "oblique";

    public string Title => "impacts with friction and spin: grip or slip, back and forth, between floor and ceiling; energy never grows";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double along, double turning) in context.Sizes([(2.0, 0.0), (2, 40)], [(2, 0), (2, 40), (-3, 1), (1e-3, 0), (100, -100), (1e4, 7.0)]))
        {
            foreach (double mu in context.Sizes([0.1, 1], [1e-3, 0.1, 0.3, 1]))
            {
                yield return Bounce(along, turning, mu, FlyOff(context, along, turning, mu));
            }
        }

        int bounces = context.Size(8, 30);
        yield return Between(bounces, Ladder(context, bounces, 1));
        foreach (double e in context.Sizes([1.0], [1, 0.9, 0.5]))
        {
            yield return Energy(context, context.Size(20, 1000), e, 1);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        yield return Bounce(2, 0, 0.01, FlyOff(context, 2, 0, 0.01 * (1 + 1e-9))) with { Note = "friction off by 1e-9" };
        yield return Bounce(2, 0, 1, (V(2 * 2.0 / 3, E * Down), V(0, 0, -2 * 2.0 / 3 / Radius))) with { Note = "as a hoop grips, a third in place of 2/7" };
        yield return Between(8, Ladder(context, 8, 0.01)) with { Note = "friction that cannot always stop the slip" };
        yield return Energy(context, 20, 1, -1) with { Note = "friction pushes along with the slip" };
    }

    private static (Vector3D Velocity, Vector3D Spin) FlyOff(HardContext context, double along, double turning, double mu)
    {
        Scene scene = Floating("oblique").AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", new BodySpec(Radius, 3, E, friction: mu), V(0, 1.5), V(along, -Down), spin: V(0, 0, turning / Radius)).Build();
        BodyState state = Read(context.Run(scene, 1), 0, 1);
        return (state.Velocity, state.Spin);
    }

    private HardRow Bounce(double along, double turning, double mu, (Vector3D Velocity, Vector3D Spin) seen)
    {
        double slip = along + turning, most = mu * (1 + E) * Down, change = -Math.Sign(slip) * Math.Min(2.0 / 7 * Math.Abs(slip), most);
        bool grips = 2.0 / 7 * Math.Abs(slip) <= most;
        double off = Math.Max((seen.Velocity - V(along + change, E * Down)).Length, ((seen.Spin * Radius) - V(0, 0, turning + (2.5 * change))).Length);
        return new HardRow(
            Name, FormattableString.Invariant($"{along} m/s along and {turning} m/s of turning, mu {mu}: {(grips ? "grips" : "slips")}"), off,
            "velocity_m_per_s",
            16 * Rounding.Unit * (Math.Abs(along) + Math.Abs(turning) + Down), "16 roundings of the speeds", grips ? "v - 2/7 u, no slip left" : "v - "
                + "mu (1 + e) n, r w - 5/2 of it");
    }

    /// <summary>Returns the tangential velocities after each bounce of an elastic ball between a floor and a ceiling.</summary>
    private static double[] Ladder(HardContext context, int bounces, double mu)
    {
        // Nine heights between the surfaces: a flight takes 8/40 s, which is no whole number of ticks.
        Scene scene = Floating("between").AddPlane("floor", Vector3D.Up, Vector3D.Zero).AddPlane("ceiling", V(0, -1), V(0, 9))
            .AddBody("ball", new BodySpec(Radius, 1, 1, friction: mu), V(0, 4.5), V(7, -40)).Build();
        List<double> along = [];
        foreach (Timelines.TimelineEntry entry in Impacts(context.Run(scene, 0.1 + (0.2 * bounces)), First))
        {
            along.Add(entry.State.Velocity.X);
        }

        return [.. along];
    }

    /// <summary>Each surface reverses the spin's effect: after the first grip its slip on the next is twice its speed.</summary>
    private HardRow Between(int bounces, double[] along)
    {
        double worst = along.Length >= bounces ? 0 : double.NaN;
        for (int n = 0; n < along.Length; n++)
        {
            double expected = 5 * Math.Pow(3.0 / 7, n); // 5/7 of 7 m/s, then 3/7 a bounce
            worst = Math.Max(worst, Math.Abs((along[n] / expected) - 1));
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{bounces} grips between floor and ceiling"), worst, "velocity_relative", 64 * Rounding.Unit * bounces,
            "8 roundings a grip of the turning, which is taken from the speed and is 7/3 of what is left at most, twice", "5/7 v (3/7)^(n-1)");
    }

    /// <summary>Four random spheres that collide obliquely and spinning, and a floor. Returns their largest gain of energy.</summary>
    private HardRow Energy(HardContext context, int scenes, double e, double sign)
    {
        double worst = double.NegativeInfinity;
        for (int n = 0; n < scenes; n++)
        {
            SeededRandom random = new((context.Seed << 24) + (ulong)n);
            SceneBuilder builder = new SceneBuilder("rub").AddPlane("floor", Vector3D.Up, Vector3D.Zero, 1, random.NextDouble());
            for (int body = 0; body < 4; body++)
            {
                builder.AddBody(
                    FormattableString.Invariant($"ball {body}"),
                    new BodySpec(random.NextDouble(0.1, 0.5), random.NextDouble(0.1, 10), e, friction: random.NextDouble()),
                    V(1.1 * body, random.NextDouble(0.5, 3)), Any(random) * 3, spin: Any(random) * 20);
            }

            Simulation simulation = context.Simulate(builder.Build());
            double before = SceneEnergy.Of(simulation, SimTime.Zero), start = before;
            for (int k = 1; k <= 30; k++)
            {
                simulation.AdvanceTo(SimTime.FromSeconds(0.1 * k));
                double now = SceneEnergy.Of(simulation, SimTime.FromSeconds(0.1 * k));
                bool isInSteps = Enumerable.Range(0, 4).Any(body => Read(simulation, body, 0.1 * k).Motion == MotionLaw.Constrained);
                worst = isInSteps || double.IsNaN(before) ? worst : Math.Max(worst, sign * (now - before) / start);
                // Velocities are those of the middle of a step there, which island-energy and heap cover.
                before = isInSteps ? double.NaN : now;
            }

            context.Report((double)n / scenes);
        }

        return new HardRow(
            Name, FormattableString.Invariant($"{scenes:N0} scenes of four balls and a floor, e {e}"), worst, "energy_gain_relative", 16 * 40 * Rounding.Unit,
            "16 roundings an impact of the whole energy, and no more than forty impacts in a tenth of a second", "friction takes energy, restitution too");
    }

    private static Vector3D Any(SeededRandom random) => V(random.NextGaussian(), random.NextGaussian(), random.NextGaussian());
}
