using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>
/// What the simplest scene costs, a ball that bounces elastically, and the hash of what happened. It asks for nothing that the first versions did not have, so
/// that it runs with their assemblies in place of today's.
/// </summary>
internal static class BounceTable
{
    internal static void Print(bool brief)
    {
        Console.WriteLine($"An elastic ball, Ballistic; CPU time of the process, best and median of {(brief ? 5 : 30)}");
        Console.WriteLine("| what | us, best / median | events | hash of all events |");
        Console.WriteLine("|---|---|---|---|");
        Simulation bouncing = new(BuiltInScenes.Drop(0.51, 1, MotionLaw.Ballistic));
        bouncing.AdvanceTo(SimTime.FromSeconds(brief ? 20_000 : 200_000)); // until the compiler has finished with it
        Row("a simulated second of 11 bounces", brief, () => bouncing.AdvanceTo(bouncing.SimulatedTo + SimDuration.FromSeconds(1)), () => bouncing);
        Scene scene = BuiltInScenes.Drop(5, 1, MotionLaw.Ballistic);
        Simulation dropped = bouncing;
        Row("a new world, and 3 s of a drop from 5 m", brief, Drop, () => dropped);

        void Drop()
        {
            dropped = new Simulation(scene);
            dropped.AdvanceTo(SimTime.FromSeconds(3));
        }
    }

    private static void Row(string what, bool brief, Action act, Func<Simulation> world)
    {
        const int each = 40_000;
        List<double> times = new();
        Process process = Process.GetCurrentProcess();
        for (int n = 0; n < (brief ? 5 : 30); n++)
        {
            process.Refresh();
            double began = process.TotalProcessorTime.TotalMicroseconds;
            for (int i = 0; i < each; i++)
            {
                act();
            }

            process.Refresh();
            times.Add((process.TotalProcessorTime.TotalMicroseconds - began) / each);
        }

        times.Sort();
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"| {what} | {times[0]:0.00} / {times[times.Count / 2]:0.00} | {world().EventsProcessed:N0} | {world().EventHash(world().SimulatedTo):x16} |"));
    }
}
