using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What late events cost in heaps: four players push balls of one heap all the time, and each push is heard of 100 ms late.</summary>
internal static class HeapHealTable
{
    private const int Players = 4;
    private const double EventsPerSecond = 20; // of each player
    private const double Late = 0.1;
    private const double Frame = 1.0 / 60;
    private const double Push = 0.5; // N s, of a ball of 1 kg
    private const double History = 0.5;
    private const double Radius = 0.1;

    internal static void Print(bool brief)
    {
        Print(new Row(20, 0.4, 1, true)); // for the compiler
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"Heaps of balls of {Radius} m and 1 kg in a pit, friction 0.3, restitution 0.2, at the default tolerance; once all lies, {Players} players push balls drawn at random by {Push} N s,"
            + $" {EventsPerSecond} times a second each, and what they do comes {Late * 1000:0} ms late, at frames of 1/60 s; H = {History} s; {ThreadClock.Name} of the thread"));
        Console.WriteLine(
            "| balls | pit, m | share of real time | of it in heals | in time: share of real time | late events a heal | bodies a heal | events run again a heal | heal p50 / p99, ms | segments kept a body | "
            + "whole world by the collector, MB | work counted a µs, late / in time |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|---|---|---|");
        foreach (Row row in brief ? [new Row(20, 0.4, 1, true)] : new[] { new Row(63, 0.4, 5, true), new Row(63, 0.8, 5, true), new Row(1_000, 1.1, 2, true), new Row(1_000, 1.1, 1, true, 0.01) })
        {
            Console.WriteLine(Print(row));
        }
    }

    private static string Print(Row row)
    {
        (double inTime, _, _, _, double countedInTime) = Play(row with { IsLate = false });
        (double seconds, List<(HealReport Heal, double Milliseconds)> heals, double kept, double mega, double counted) = Play(row);
        Percentiles times = Percentiles.Of(heals.Select(h => h.Milliseconds));
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {row.Balls:N0}{(row.Tolerance is double d ? $", d = {d} m" : "")} | {2 * row.Half} | {seconds / row.Seconds:0.00} | {heals.Sum(h => h.Milliseconds) / 1000 / row.Seconds:0.00} | {inTime / row.Seconds:0.00} "
            + $"| {heals.Average(h => h.Heal.LateEvents):0.0} | {heals.Average(h => h.Heal.Bodies):0} | {heals.Average(h => h.Heal.Events):0} | {times.P50:0.0} / {times.P99:0.0} "
            + $"| {kept:0.0} | {mega:0.0} | {counted / seconds * 1e-6:0.0} / {countedInTime / inTime * 1e-6:0.0} |");
    }

    /// <summary>Runs the heap; CPU seconds, heals, what is kept in the end, and how much work a session's host would count.</summary>
    private static (double Seconds, List<(HealReport Heal, double Milliseconds)> Heals, double Kept, double Mega, double Counted) Play(
        Row row)
    {
        const double settled = 3;
        Scene scene = Heap(row);
        long before = GC.GetTotalMemory(forceFullCollection: true);
        Simulation world = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(History)));
        List<(HealReport Heal, double Milliseconds)> heals = [];
        HealReport? report = null;
        world.Healed += healed => report = healed;
        world.AdvanceTo(SimTime.FromSeconds(settled));
        Random random = new(5);
        ExternalEvent[] pushes = [.. Enumerable.Range(0, (int)(Players * EventsPerSecond * row.Seconds)).Select(n => ExternalEvent.Impulse(
            SimTime.FromSeconds(settled + (n / (Players * EventsPerSecond))), (byte)(1 + (n % Players)), (uint)n + 1, BodyId.OfScene(random.Next(row.Balls)),
            new Vector3D(random.NextDouble() - 0.5, random.NextDouble(), random.NextDouble() - 0.5) * (2 * Push)))];
        WorkLedger work = new() { MaxWorkPerStep = double.PositiveInfinity };
        world.Engine.Meter.Observer = work;
        double began = ThreadClock.Microseconds;
        int next = 0;
        for (double now = settled; now < settled + row.Seconds; now += Frame)
        {
            double frame = ThreadClock.Microseconds;
            SimTime until = world.SimulatedTo;
            for (; next < pushes.Length && pushes[next].Time.ToSeconds() + (row.IsLate ? Late : -Frame) <= now; next++)
            {
                world.Submit(pushes[next]);
            }

            world.AdvanceTo(until);
            if (report is HealReport heal)
            {
                heals.Add((heal, (ThreadClock.Microseconds - frame) / 1000));
                report = null;
            }

            world.AdvanceTo(SimTime.FromSeconds(now + Frame));
        }

        double seconds = (ThreadClock.Microseconds - began) / 1e6;
        double mega = (GC.GetTotalMemory(forceFullCollection: true) - before) * 1e-6;
        return (seconds, heals, world.Engine.Timelines.Alive / (double)row.Balls, mega, work.Total);
    }

    private static Scene Heap(Row row)
    {
        Random random = new(7);
        SceneBuilder builder = new SceneBuilder("heap").AddPlane("floor", Vector3D.Up, 0.0)
            .AddPlane("west", new Vector3D(1, 0, 0), -row.Half).AddPlane("east", new Vector3D(-1, 0, 0), -row.Half)
            .AddPlane("north", new Vector3D(0, 0, 1), -row.Half).AddPlane("south", new Vector3D(0, 0, -1), -row.Half);
        builder = row.Tolerance is double tolerance ? builder.WithContactTolerance(tolerance) : builder;
        BodySpec ball = new(Radius, 1, 0.2, friction: 0.3);
        int side = (int)(row.Half / (1.2 * Radius));
        for (int n = 0; n < row.Balls; n++)
        {
            builder.AddBody($"ball {n}", ball, new Vector3D(Place(n % side), 0.15 + (0.25 * (n / (side * side))), Place(n / side % side)));
        }

        return builder.Build();

        double Place(int n) => ((n + 0.5) * 2 * row.Half / side) - row.Half + (0.02 * (random.NextDouble() - 0.5));
    }

    private readonly record struct Row(int Balls, double Half, double Seconds, bool IsLate, double? Tolerance = null);
}
