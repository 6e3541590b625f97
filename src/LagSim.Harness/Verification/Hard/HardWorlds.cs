using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Hard;

/// <summary>Small worlds, and the queries of the hard cases.</summary>
internal static class HardWorlds
{
    internal const double Gravity = 9.81;

    internal static readonly BodyId First = BodyId.OfScene(0);

    internal static Vector3D V(double x, double y = 0, double z = 0) => new(x, y, z);

    internal static BodySpec Ball(double radius = 0.5, double mass = 1, double e = 1) => new(radius, mass, e);

    internal static SceneBuilder Floating(string name) => new SceneBuilder(name).WithGravity(Vector3D.Zero);

    internal static BodyState Read(Simulation simulation, BodyId body, SimTime time)
    {
        simulation.TryRead(body, time, out BodyState state);
        return state;
    }

    internal static BodyState Read(Simulation simulation, int body, double seconds) => Read(simulation, BodyId.OfScene(body), SimTime.FromSeconds(seconds));

    internal static List<TimelineEntry> Impacts(Simulation simulation, BodyId body) =>
        simulation.Timeline(body).Where(entry => entry.Key.Kind == EventKind.Impact).ToList();

    internal static double[] ImpactTimes(Simulation simulation, BodyId body) => Impacts(simulation, body).Select(entry => entry.Key.Time.ToSeconds()).ToArray();

    /// <summary>Returns the times at which a body bounced, and the number of segments of its path since the bounce before.</summary>
    internal static List<(double Time, int Pieces)> Hops(Simulation simulation, BodyId body)
    {
        List<(double Time, int Pieces)> hops = [];
        int pieces = 0;
        foreach (TimelineEntry entry in simulation.Timeline(body))
        {
            if (entry.Key.Kind == EventKind.Impact)
            {
                hops.Add((entry.Key.Time.ToSeconds(), pieces));
                pieces = 0;
            }

            pieces++;
        }

        return hops;
    }

    internal static Vector3D Momentum(Simulation simulation, double seconds) => Enumerable.Range(0, simulation.BodyCount).Aggregate(
        Vector3D.Zero, (sum, n) => sum + (Read(simulation, n, seconds).Velocity * simulation.SpecOf(BodyId.OfScene(n)).Mass));

    /// <summary>Returns the largest of some errors; NaN for none. Throws if one is NaN, since a comparison would ignore it.</summary>
    internal static double Worst(IEnumerable<double> errors)
    {
        double worst = double.NaN;
        foreach (double error in errors)
        {
            worst = double.IsNaN(error) ? throw new InvalidOperationException("An error is not a number.") : worst >= error ? worst : error;
        }

        return worst;
    }
}
