using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Reflection;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Bench;

/// <summary>What completed events take in memory, against bodies x segments a second x history x bytes a segment; and what else a world takes.</summary>
internal static class MemoryTable
{
    private const double Fraction = 0.2;
    private const double History = 1;

    internal static void Print(bool brief)
    {
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"Memory after 3 s of gas at volume fraction {Fraction}, H = {History} s; a segment with its key and links takes {SegmentBytes()} bytes"));
        Console.WriteLine(
            "| bodies | segments a second each | kept each | formula, MB | room for segments, MB | room : formula | the same with one segment more a body "
            + "| neighbour lists, MB | all else, MB | whole world by the collector, MB |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|---|");
        foreach (int bodies in brief ? new[] { 1_000 } : new[] { 1_000, 2_000, 4_000, 10_000, 30_000 })
        {
            Console.WriteLine(Row(bodies));
        }
    }

    /// <summary>What a segment takes: of each array with an entry a segment one element. Coefficients and hands, which a gas has none of, are apart.</summary>
    internal static int SegmentBytes()
    {
        TimelineStore store = new(default);
        store.AddSlot(0);
        return typeof(TimelineStore).GetFields(BindingFlags.Instance | BindingFlags.NonPublic)
            .Where(f => f.FieldType.IsArray && ((Array)f.GetValue(store)!).Length == store.Room)
            .Sum(f => ObjectSize.SizeOf(f.FieldType.GetElementType()!));
    }

    private static string Row(int bodies)
    {
        Scene scene = BuiltInScenes.Gas(bodies, Fraction);
        long before = GC.GetTotalMemory(forceFullCollection: true);
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(History)));
        simulation.AdvanceTo(SimTime.FromSeconds(2));
        long opened = simulation.Engine.Timelines.LastSerial;
        simulation.AdvanceTo(SimTime.FromSeconds(3));
        double rate = (simulation.Engine.Timelines.LastSerial - opened) / (double)bodies;
        double whole = GC.GetTotalMemory(forceFullCollection: true) - before;
        HashSet<object> seen = new(ReferenceEqualityComparer.Instance) { scene };
        double timelines = simulation.Engine.Timelines.Room * (double)SegmentBytes();
        double perBody = ObjectSize.Of(simulation.Engine.Timelines, seen) - timelines;
        double index = ObjectSize.Of(simulation.Engine.BroadPhase.Current, seen);
        double rest = perBody + ObjectSize.Of(simulation, seen);
        double formula = bodies * rate * History * SegmentBytes();
        double withLast = formula + (bodies * SegmentBytes());
        const double mega = 1e-6;
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {bodies:N0} | {rate:0.00} | {simulation.Engine.Timelines.Alive / (double)bodies:0.00} | {formula * mega:0.00} | {timelines * mega:0.00} | {timelines / formula:0.00} | {timelines / withLast:0.00} "
            + $"| {index * mega:0.00} | {rest * mega:0.00} | {whole * mega:0.00} |");
    }
}
