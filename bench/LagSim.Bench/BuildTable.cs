using System;
using System.Diagnostics;
using System.Globalization;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// What it takes to build large scenes, on one thread and on two in turns, and worlds of them; and that both make the same. By the clock, and in CPU time: where others use the second core too, the larger
/// of the two threads' shares tells what it would be.
/// </summary>
internal static class BuildTable
{
    internal static void Print(bool brief)
    {
        Console.WriteLine("Gas in a periodic box at volume fraction 0.2; the best of some, in ms; CPU time of threads");
        Console.WriteLine("| bodies | scene on 1 thread: clock / CPU | on 2: clock / CPU of the caller's / of the other | larger share : 1 thread | world: clock / CPU | bytes allocated for it | hash of the scene |");
        Console.WriteLine("|---|---|---|---|---|---|---|");
        foreach (int bodies in brief ? new[] { 1_000, 20_000 } : new[] { 1_000, 10_000, 30_000, 100_000 })
        {
            Scene scene = BuiltInScenes.Gas(bodies, 0.2);
            Sample one = Sample.None, two = Sample.None, world = Sample.None;
            for (int n = 0; n < Math.Max(10, (brief ? 100_000 : 2_000_000) / bodies); n++)
            {
                one = one.Best(Build(scene, 1));
                two = two.Best(Build(scene, 2));
                world = world.Best(Of(() => _ = new Simulation(scene, new SimulationOptions(default, SimDuration.FromMilliseconds(250)))));
            }

            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"| {bodies:N0} | {one.Clock:0.0} / {one.Caller:0.0} | {two.Clock:0.0} / {two.Caller:0.0} / {two.Other:0.0} | {Math.Max(two.Caller, two.Other) / one.Caller:0.00} | {world.Clock:0.0} / {world.Caller:0.0} | {world.Bytes:N0} | {scene.Hash:x16} |"));
        }
    }

    private static Sample Build(Scene scene, int threads)
    {
        SceneBuilder builder = Copy(scene).WithThreads(threads);
        Scene? built = null;
        Sample sample = Of(() => built = builder.Build());
        return built!.Hash == scene.Hash
            ? sample
            : throw new InvalidOperationException($"On {threads} threads the scene of {scene.Bodies.Count} bodies has another hash.");
    }

    private static Sample Of(Action act)
    {
        using Process process = Process.GetCurrentProcess();
        double all = process.TotalProcessorTime.TotalMilliseconds;
        double caller = ThreadClock.Microseconds;
        long bytes = GC.GetAllocatedBytesForCurrentThread();
        Stopwatch watch = Stopwatch.StartNew();
        act();
        double clock = watch.Elapsed.TotalMilliseconds;
        bytes = GC.GetAllocatedBytesForCurrentThread() - bytes;
        caller = (ThreadClock.Microseconds - caller) / 1000;
        process.Refresh();
        return new Sample(clock, caller, Math.Max(0, process.TotalProcessorTime.TotalMilliseconds - all - caller), bytes);
    }

    private static SceneBuilder Copy(Scene scene)
    {
        SceneBuilder builder = new SceneBuilder(scene.Name).WithGravity(scene.Gravity).WithPeriodicBox(scene.Box.Size).WithSmallestRadius(scene.SmallestRadius);
        foreach (SceneBody body in scene.Bodies)
        {
            builder.AddBody(body.Name, body.Spec, body.Position, body.Velocity, body.Players, body.Spin);
        }

        return builder;
    }

    private sealed record Sample(double Clock, double Caller, double Other, long Bytes)
    {
        internal static readonly Sample None = new(double.MaxValue, double.MaxValue, double.MaxValue, 0);

        internal Sample Best(Sample other) => new(Math.Min(Clock, other.Clock), Math.Min(Caller, other.Caller), Math.Min(Other, other.Other), other.Bytes);
    }
}
