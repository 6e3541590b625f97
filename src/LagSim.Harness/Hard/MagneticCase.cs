using System;
using System.Collections.Generic;
using LagSim.Harness.Forces;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>A force across the velocity: a circle, or with gravity a cycloid; the speed must not decay by more than the method's own share.</summary>
/// <remarks>
/// The classical method turns the velocity, less its drift, by R(iz) a step, z = omega h: |R| = sqrt(1 - z^6/72 + z^8/576), its argument z less z^5/120 and
/// smaller terms. v - x cross omega, which is linear, is kept, so the place is off by as much as the velocity over omega.
/// </remarks>
internal sealed class MagneticCase : IHardCase
{
    private const double Step = 1.0 / 64;

    private static readonly Vector3D Start = V(3, 0, 0.5);

    public string Name => "magnetic";

    public string Title => "a magnetic or Magnus force (v x omega), alone and with gravity, on Runge-Kutta steps";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double z, int steps) in context.Sizes([(0.1, 1000)], [(0.02, 100_000), (0.1, 10_000), (0.5, 1000)]))
        {
            foreach (double gravity in new[] { 0, Gravity })
            {
                Scene scene = new SceneBuilder("gyration").WithGravity(V(0, -gravity)).AddForce(Force.Supplied(new MagneticForce(V(0, 0, z / Step))))
                    .AddBody("ball", Stepped(Step, 0.01), default, Start).Build();
                Simulation simulation = context.Simulate(scene);
                simulation.AdvanceTo(SimTime.FromSeconds(steps * Step));
                BodyState state = Read(simulation, 0, steps * Step);
                foreach (HardRow row in RowsOf(z, steps, gravity, state.Position, state.Velocity))
                {
                    yield return row;
                }
            }
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        const double z = 0.1;
        foreach (double gravity in new[] { 0, Gravity })
        {
            (Vector3D x, Vector3D v) = ClassicalRungeKutta.Run(
                (f, t, x, v, h) => (x + ((v + (f(t, x, v) * (h / 2))) * h), v + (f(t + (h / 2), x, v + (f(t, x, v) * (h / 2))) * h)),
                ClassicalRungeKutta.Of(new MagneticForce(V(0, 0, z / Step)), V(0, -gravity)), default, Start, Step, 1000);
            foreach (HardRow row in RowsOf(z, 1000, gravity, x, v))
            {
                yield return row with { Note = "the midpoint method" };
            }
        }
    }

    private IEnumerable<HardRow> RowsOf(double z, int steps, double gravity, Vector3D x, Vector3D v)
    {
        double omega = z / Step, t = steps * Step, angle = omega * t;
        Vector3D drift = V(-gravity / omega); // a = g + v x omega vanishes on it
        Vector3D turning = Start - drift;
        double across = Math.Sqrt((turning.X * turning.X) + (turning.Y * turning.Y));
        double cos = Math.Cos(angle), sin = Math.Sin(angle); // v' = v x omega turns clockwise about z
        Vector3D velocity = V((turning.X * cos) + (turning.Y * sin), (turning.Y * cos) - (turning.X * sin), turning.Z);
        Vector3D place = (drift * t) + V(((turning.X * sin) + (turning.Y * (1 - cos))) / omega, ((turning.Y * sin) - (turning.X * (1 - cos))) / omega,
            turning.Z * t);
        string size = FormattableString.Invariant($"omega h = {z}, {steps:N0} steps{(gravity > 0 ? ", gravity" : "")}");

        double seen = Math.Sqrt(Math.Pow(v.X - drift.X, 2) + Math.Pow(v.Y - drift.Y, 2));
        double loss = 1 - Math.Pow(1 - (Math.Pow(z, 6) / 72) + (Math.Pow(z, 8) / 576), steps / 2.0);
        double rounding = 40 * Rounding.Walk(steps) * (1 + (drift.Length / across));
        yield return new HardRow(
            Name, size, Math.Abs((seen / across) - 1), "speed_relative", loss + rounding,
            "the method's own loss, 1 - (1 - z^6/72 + z^8/576)^(n/2), and a walk of 40 roundings a step",
                "v x omega does no work: the speed beside the drift stays");

        double phase = steps * Math.Pow(z, 5) / 120;
        yield return new HardRow(
            Name, size, (x - place).Length, "position_m", (across / omega * (phase + loss)) + (rounding * (across / omega))
                + (40 * Rounding.Walk(steps) * (place.Length + (across / omega))),
            "radius x (n z^5/120 of phase and the loss of speed), and a walk of 40 roundings a step of the place", "circle and drift in closed form");
    }
}
