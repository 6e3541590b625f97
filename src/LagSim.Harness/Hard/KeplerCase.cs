using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Forces;
using LagSim.Scenes;
using LagSim.Time;
using static LagSim.Harness.Hard.HardWorlds;

namespace LagSim.Harness.Hard;

/// <summary>An orbit around a centre, against Kepler's equation: the engine is to be no further off than the classical method is at that step.</summary>
internal sealed class KeplerCase : IHardCase
{
    private const double Step = 1.0 / 64;
    private const int Places = 16; // at which it is looked at

    public string Name => "kepler";

    public string Title => "one Kepler orbit from its far end, eccentricity 0 to 0.999, on fixed Runge-Kutta steps";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach ((double e, int steps) in Orbits(context))
        {
            Orbit orbit = new(e, steps);
            Scene scene = Floating("kepler").AddForce(Force.Supplied(new CentralGravity(orbit.Mu)))
                .AddBody("planet", Stepped(Step, 1e-6), orbit.Position(0), orbit.Velocity).Build();
            Simulation simulation = context.Simulate(scene);
            Vector3D[] seen = new Vector3D[Places];
            for (int n = 0; n < Places; n++)
            {
                SimTime at = SimTime.FromSeconds(orbit.StepsTo(n) * Step);
                simulation.AdvanceTo(at);
                seen[n] = Read(simulation, First, at).Position;
                context.Report((n + 1.0) / Places);
            }

            yield return Row(orbit, seen);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach ((double e, int steps) in new[] { (0.0, 256), (0.5, 1024) })
        {
            Orbit orbit = new(e, steps);
            yield return Row(orbit, Textbook(orbit, ClassicalRungeKutta.ThesisStep)) with { Note = "the thesis's update of the position" };
        }
    }

    private static (double E, int Steps)[] Orbits(HardContext context) =>
        context.Sizes([(0.0, 256), (0.5, 1024)], [(0.0, 256), (0.5, 1024), (0.9, 16_384), (0.99, 131_072), (0.999, 2_097_152)]);

    private static Vector3D[] Textbook(Orbit orbit, ClassicalRungeKutta.Method method)
    {
        ClassicalRungeKutta.Acceleration pull = ClassicalRungeKutta.Of(new CentralGravity(orbit.Mu));
        Vector3D[] seen = new Vector3D[Places];
        (Vector3D x, Vector3D v, long done) = (orbit.Position(0), orbit.Velocity, 0L);
        for (int n = 0; n < Places; n++)
        {
            (x, v) = ClassicalRungeKutta.Run(method, pull, x, v, Step, orbit.StepsTo(n) - done);
            (seen[n], done) = (x, orbit.StepsTo(n));
        }

        return seen;
    }

    private HardRow Row(Orbit orbit, Vector3D[] seen)
    {
        double own = orbit.WorstOf(Textbook(orbit, ClassicalRungeKutta.Step));
        double rounding = 10 / (1 - orbit.E) * 40 * Rounding.Walk(orbit.Steps);
        return new HardRow(
            Name, FormattableString.Invariant($"e {orbit.E}, {orbit.Steps:N0} steps"), orbit.WorstOf(seen), "position_over_semi_major_axis", (1.01 * own)
                + rounding,
            "what the textbook's classical method leaves at this very step, written apart from the engine, and 1 % of it; a walk of 40 roundings a step, which the orbit magnifies by 10/(1 - e)",
            "Kepler's equation, at 16 instants of the orbit");
    }

    /// <summary>An orbit with a semi-major axis of 1 m that takes so many steps.</summary>
    private sealed class Orbit(double e, int steps)
    {
        internal double E => e;

        internal int Steps => steps;

        internal double Motion { get; } = 2 * Math.PI / (steps * Step); // radians a second

        internal double Mu => Motion * Motion;

        /// <summary>At the far end, where it starts.</summary>
        internal Vector3D Velocity => V(0, -Math.Sqrt(Mu * (1 - e) / (1 + e)));

        internal long StepsTo(int place) => (place + 1L) * steps / Places;

        internal Vector3D Position(double seconds)
        {
            double mean = Math.PI + (Motion * seconds), anomaly = mean;
            double low = mean - e, high = mean + e;
            for (int n = 0; n < 100; n++)
            {
                anomaly = 0.5 * (low + high); // bisection, since Newton's method has its own troubles at 0.999
                (low, high) = anomaly - (e * Math.Sin(anomaly)) < mean ? (anomaly, high) : (low, anomaly);
            }

            return V(Math.Cos(anomaly) - e, Math.Sqrt(1 - (e * e)) * Math.Sin(anomaly));
        }

        internal double WorstOf(Vector3D[] seen) => Worst(seen.Select((x, n) => (x - Position(StepsTo(n) * Step)).Length));
    }
}
