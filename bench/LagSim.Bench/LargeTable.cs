using System;
using System.Diagnostics;
using System.Globalization;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What an event costs among few and among very many bodies at equal density, and what so many take: memory, and the time to build them.</summary>
internal static class LargeTable
{
    private const double Fraction = 0.2;

    internal static void Print(bool brief)
    {
        Row(1_000, brief ? 20_000 : 100_000); // so that nothing is measured that the compiler has not finished with
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"Gas in a periodic box at volume fraction {Fraction}, a history of 250 ms; the first 0.5 s are not counted; {ThreadClock.Name} of the thread"));
        Console.WriteLine(
            "| bodies | build the scene, ms | build the world, ms | bytes a body | of these for segments kept | events a second | us an event | against 1,000 bodies |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|");
        double first = 0;
        foreach (int bodies in brief ? new[] { 1_000, 10_000 } : new[] { 1_000, 10_000, 100_000 })
        {
            (string row, double each) = Row(bodies, brief ? 20_000 : Math.Max(300_000, 5 * bodies));
            first = first == 0 ? each : first;
            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{row} | {each / first:0.00} |"));
        }
    }

    private static (string Row, double Microseconds) Row(int bodies, long events)
    {
        Stopwatch watch = Stopwatch.StartNew();
        Scene scene = BuiltInScenes.Gas(bodies, Fraction);
        double sceneBuilt = watch.Elapsed.TotalMilliseconds;
        long before = GC.GetTotalMemory(forceFullCollection: true);
        watch.Restart();
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.FromMilliseconds(250)));
        double built = watch.Elapsed.TotalMilliseconds;
        simulation.AdvanceTo(SimTime.FromSeconds(0.5));
        long until = simulation.EventsProcessed + events;
        long happened = simulation.EventsProcessed;
        double began = ThreadClock.Microseconds;
        while (simulation.EventsProcessed < until)
        {
            simulation.AdvanceTo(simulation.SimulatedTo + SimDuration.FromSeconds(0.01));
        }

        double each = (ThreadClock.Microseconds - began) / (simulation.EventsProcessed - happened);
        double bytes = (GC.GetTotalMemory(forceFullCollection: true) - before) / (double)bodies;
        double segments = simulation.Engine.Timelines.Room * (double)MemoryTable.SegmentBytes() / bodies;
        string row = string.Create(
            CultureInfo.InvariantCulture, $"| {bodies:N0} | {sceneBuilt:N0} | {built:N0} | {bytes:N0} | {segments:N0} | {1e6 / each:N0} | {each:0.00}");
        GC.KeepAlive(simulation);
        return (row, each);
    }
}
