using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// The events must be the same, in the same order, with any broad phase and any number of threads that each run a world.
/// </summary>
internal sealed class EventOrderCase : IHardCase
{
    private static readonly int[] Threads = [2, 3, 7];

    public string Name => "event-order";

    public string Title =>
        "a long run of a crowd: the same events, to the bit, whether the broad phase is brute force or a neighbour list, on any number of threads";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        (int bodies, double seconds) = context.Size((80, 190.0), (200, 3200.0));
        Scene scene = BuiltInScenes.Crowd(bodies);
        double whole = 2 + Threads.Length;
        World pairs = Run(context, scene, seconds, int.MaxValue, part => context.Report(part / whole));
        World index = Run(context, scene, seconds, 0, part => context.Report((1 + part) / whole));
        yield return Row(FormattableString.Invariant($"{bodies} balls, {pairs.Count:N0} events"), pairs, index);
        for (int n = 0; n < Threads.Length; n++)
        {
            double done = 2 + n;
            World[] worlds = Together(context, scene, seconds, Threads[n], part => context.Report((done + part) / whole));
            yield return Row(FormattableString.Invariant($"the same on {Threads[n]} threads at a time"), pairs, worlds);
        }
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        Scene scene = BuiltInScenes.Crowd(80);
        World pairs = Run(context, scene, 10, int.MaxValue, _ => { });
        const string note = "one ball a unit in the last place further on";
        World nudged = Run(context, Nudged(scene), 10, 0, _ => { });
        yield return Row(FormattableString.Invariant($"80 balls, {pairs.Count:N0} events"), pairs, nudged) with { Note = note };
        yield return Row("the same on 2 threads at a time", pairs, Together(context, Nudged(scene), 10, 2, _ => { })) with { Note = note };
    }

    private static Scene Nudged(Scene scene)
    {
        SceneBuilder builder = new SceneBuilder(scene.Name).WithGravity(scene.Gravity);
        foreach (StaticPlane plane in scene.Planes)
        {
            builder.AddPlane(plane.Name, plane.Normal, plane.Offset, plane.Restitution);
        }

        foreach (SceneBody body in scene.Bodies)
        {
            Vector3D at = body.Position;
            builder.AddBody(body.Name, body.Spec, body.Name == scene.Bodies[0].Name ? new Vector3D(Math.BitIncrement(at.X), at.Y, at.Z) : at, body.Velocity);
        }

        return builder.Build();
    }

    /// <summary>Runs the scene on a number of threads at the same time, every other one with neighbour lists.</summary>
    private static World[] Together(HardContext context, Scene scene, double seconds, int threads, Action<double> report)
    {
        World[] worlds = new World[threads];
        Exception?[] failures = new Exception?[threads];
        Thread[] others = [.. Enumerable.Range(1, threads - 1).Select(n => new Thread(() => RunInto(n, _ => { })) { IsBackground = true })];
        Array.ForEach(others, thread => thread.Start());
        RunInto(0, report);
        Array.ForEach(others, thread => thread.Join());
        return Array.Find(failures, failure => failure is not null) is { } first ? throw first : worlds;

        void RunInto(int n, Action<double> told)
        {
            try
            {
                worlds[n] = Run(context, scene, seconds, n % 2 == 0 ? 0 : int.MaxValue, told);
            }
            catch (Exception failure)
            {
                failures[n] = failure; // reported by the calling thread
            }
        }
    }

    private static World Run(HardContext context, Scene scene, double seconds, int bruteForceLimit, Action<double> report)
    {
        Simulation simulation = new(scene, new SimulationOptions(cancellation: context.Cancellation).WithBruteForceLimit(bruteForceLimit));
        SimTime end = SimTime.FromSeconds(seconds);
        while (simulation.SimulatedTo < end)
        {
            simulation.AdvanceTo(SimTime.Min(end, simulation.SimulatedTo + SimDuration.FromSeconds(1)));
            report((simulation.SimulatedTo - SimTime.Zero).ToSeconds() / seconds);
        }

        return new World(simulation.EventHash(end), simulation.StateHash(end), simulation.EventsProcessed);
    }

    private HardRow Row(string size, World bruteForce, params World[] worlds) => new(
        Name,
        size,
        worlds.Sum(w => (w.Events != bruteForce.Events ? 1 : 0) + (w.State != bruteForce.State ? 1 : 0)),
        "hashes_that_differ",
        0,
        "a hash of every event's key and outcome and one of all states at the end: a bit is right or wrong",
        "the run on one thread by brute force");

    private readonly record struct World(ulong Events, ulong State, long Count);
}
