using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>Elastic worlds whose every error can be told: how fast they run, what becomes of their energy, and how deep anything is ever in anything.</summary>
internal static class WalledGasTable
{
    private const double Radius = 0.5;

    internal static void Print(bool brief)
    {
        Console.WriteLine($"Elastic worlds, default options; {ThreadClock.Name} of the thread, best and median of {(brief ? 3 : 9)} runs from the start");
        Console.WriteLine(
            "| scene | simulated, s | impacts | simulated s per s, best / median | us an impact, best | relative energy error "
            + "| deepest overlap, m | instants looked at |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|");
        Print("gas", Gas(), 10, brief);
        Print("elastic49", Elastic49(), 20, brief);
        Print("drop", Drop(), 3, brief);
    }

    /// <summary>1,000 balls at a volume fraction of 0.2 in a cube with walls, speeds normal with a standard deviation of 1 m/s along each axis.</summary>
    private static Scene Gas()
    {
        const int along = 10;
        double side = 2 * Radius * Math.Cbrt(along * along * along * Math.PI / 6 / 0.2);
        SceneBuilder builder = new SceneBuilder("gas").WithGravity(Vector3D.Zero);
        foreach ((string axis, Vector3D normal) in new[] { ("x", new Vector3D(1, 0, 0)), ("y", new Vector3D(0, 1, 0)), ("z", new Vector3D(0, 0, 1)) })
        {
            builder.AddPlane($"{axis} from", normal, 0.0).AddPlane($"{axis} to", -normal, -side);
        }

        SeededRandom speeds = new(1);
        for (int n = 0; n < along * along * along; n++)
        {
            Vector3D place = new Vector3D((n % along) + 0.5, (n / along % along) + 0.5, (n / along / along) + 0.5) * (side / along);
            Vector3D velocity = new(speeds.NextGaussian(), speeds.NextGaussian(), speeds.NextGaussian());
            builder.AddBody($"ball {n + 1}", new BodySpec(Radius, 1, 1), place, velocity);
        }

        return builder.Build();
    }

    /// <summary>7 x 7 balls 2 m apart over a plane, their centres at heights of 1.5 m to 6.3 m.</summary>
    private static Scene Elastic49()
    {
        SceneBuilder builder = new SceneBuilder("elastic49").AddPlane("floor", Vector3D.Up, 0.0);
        for (int n = 0; n < 49; n++)
        {
            builder.AddBody($"ball {n + 1}", new BodySpec(Radius, 1, 1), new Vector3D(n % 7 * 2, 1.5 + (0.1 * n), n / 7 * 2), Vector3D.Zero);
        }

        return builder.Build();
    }

    private static Scene Drop() => new SceneBuilder("drop")
        .AddPlane("floor", Vector3D.Up, 0.0)
        .AddBody("ball", new BodySpec(Radius, 1, 1), new Vector3D(0, 5.5, 0), Vector3D.Zero)
        .Build();

    private static void Print(string name, Scene scene, double seconds, bool brief)
    {
        SimTime end = SimTime.FromSeconds(seconds);
        List<double> rates = new();
        Simulation timed = new(scene);
        for (int run = 0; run < (brief ? 3 : 9); run++)
        {
            int rounds = Math.Max(1, (brief ? 200 : 20_000) / (scene.Bodies.Count * scene.Bodies.Count)); // short ones are repeated
            double began = ThreadClock.Microseconds;
            for (int round = 0; round < rounds; round++)
            {
                timed = new Simulation(scene);
                timed.AdvanceTo(end);
            }

            rates.Add(rounds * seconds / (ThreadClock.Microseconds - began) * 1e6);
        }

        rates.Sort();
        int instants = brief ? 20 : 1_000;
        Simulation watched = new(scene);
        double before = Energy(watched, SimTime.Zero);
        double worst = 0;
        double deepest = 0;
        for (int i = 1; i <= instants; i++)
        {
            SimTime at = SimTime.FromSeconds(seconds * i / instants);
            watched.AdvanceTo(at);
            worst = Math.Max(worst, Math.Abs(Energy(watched, at) - before) / before);
            deepest = Math.Max(deepest, Deepest(watched, at));
        }

        if (watched.EventHash(end) != timed.EventHash(end))
        {
            throw new InvalidOperationException("What was looked at is not what was timed.");
        }

        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"| {name} | {seconds} | {timed.ImpactsProcessed:N0} | {rates.Max():N0} / {rates[rates.Count / 2]:N0} "
            + $"| {seconds / rates.Max() / timed.ImpactsProcessed * 1e6:0.00} | {worst:0.0e+0} | {deepest:0.0e+0} | {instants:N0} |"));
    }

    private static double Energy(Simulation simulation, SimTime at)
    {
        double sum = 0;
        for (int n = 0; n < simulation.BodyCount; n++)
        {
            BodyState state = State(simulation, n, at);
            sum += (0.5 * state.Velocity.LengthSquared) - Vector3D.Dot(simulation.Scene.Gravity, state.Position);
        }

        return sum;
    }

    private static BodyState State(Simulation simulation, int n, SimTime at) =>
        simulation.TryRead(simulation.BodyAt(n), at, out BodyState state) ? state : throw new InvalidOperationException($"Body {n} is not there at {at}.");

    private static double Deepest(Simulation simulation, SimTime at)
    {
        Vector3D[] places = Enumerable.Range(0, simulation.BodyCount).Select(n => State(simulation, n, at).Position).ToArray();
        double least = double.MaxValue;
        for (int n = 0; n < places.Length; n++)
        {
            for (int other = 0; other < n; other++)
            {
                least = Math.Min(least, (places[n] - places[other]).LengthSquared);
            }
        }

        double deepest = Math.Max(0, (2 * Radius) - Math.Sqrt(least));
        foreach (StaticPlane plane in simulation.Scene.Planes)
        {
            deepest = Math.Max(deepest, -places.Min(place => plane.Gap(place, Radius)));
        }

        return deepest;
    }
}
