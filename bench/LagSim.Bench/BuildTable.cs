using System;
using System.Diagnostics;
using System.Globalization;
using LagSim.Harness.Scenes;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>How long it takes to build large scenes, on one thread and on two in turns, and worlds of them; and that both make the same.</summary>
internal static class BuildTable
{
    internal static void Print(bool brief)
    {
        Console.WriteLine("Gas in a periodic box at volume fraction 0.2; the best of some, by the clock, in ms");
        Console.WriteLine("| bodies | scene on 1 thread | on 2 | on 2 : on 1 | world | bytes allocated for it | hash of the scene |");
        Console.WriteLine("|---|---|---|---|---|---|---|");
        foreach (int bodies in brief ? new[] { 1_000, 10_000 } : new[] { 1_000, 4_000, 10_000, 30_000, 100_000 })
        {
            Scene scene = BuiltInScenes.Gas(bodies, 0.2);
            double[] best = [double.MaxValue, double.MaxValue, double.MaxValue];
            long allocated = 0;
            for (int n = 0; n < Math.Max(10, (brief ? 100_000 : 2_000_000) / bodies); n++)
            {
                for (int threads = 1; threads <= 2; threads++)
                {
                    SceneBuilder builder = Copy(scene).WithThreads(threads);
                    Stopwatch watch = Stopwatch.StartNew();
                    Scene built = builder.Build();
                    best[threads - 1] = Math.Min(best[threads - 1], watch.Elapsed.TotalMilliseconds);
                    if (built.Hash != scene.Hash)
                    {
                        throw new InvalidOperationException($"On {threads} threads the scene of {bodies} bodies has another hash.");
                    }
                }

                long before = GC.GetAllocatedBytesForCurrentThread();
                Stopwatch watchWorld = Stopwatch.StartNew();
                _ = new Simulation(scene, new SimulationOptions(default, SimDuration.FromMilliseconds(250)));
                best[2] = Math.Min(best[2], watchWorld.Elapsed.TotalMilliseconds);
                allocated = GC.GetAllocatedBytesForCurrentThread() - before;
            }

            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"| {bodies:N0} | {best[0]:0.00} | {best[1]:0.00} | {best[1] / best[0]:0.00} | {best[2]:0.00} | {allocated:N0} | {scene.Hash:x16} |"));
        }
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
}
