using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What a game's frame pays for reading a whole world while that world rewrites thousands of events, in real time, and whether each render snapshot is whole.</summary>
/// <remarks>
/// Late events come in pairs of opposite kicks of one stamp on two balls of equal mass, so that in any one version of the world, at any instant, the sum of all velocities is what it
/// was at the start. Bodies of two versions, or of one that has half of a pair, would have another.
/// </remarks>
internal sealed class FrameTable
{
    private const int Bodies = 2_000;
    private const int Pairs = 200;
    private const double Tolerance = 1e-9; // m/s, of a sum of two thousand; one kick is ten million times as much
    private static readonly SimDuration Late = SimDuration.FromMilliseconds(900);
    private static readonly SimDuration Between = SimDuration.FromMilliseconds(1_500);

    private readonly IClock clock = new StopwatchClock();
    private readonly LiveWorld world;
    private readonly Random random = new(1);
    private readonly List<double> healMilliseconds = new();
    private readonly List<double> healedEvents = new();
    private readonly bool heals;
    private SimTime nextLateEvent;
    private SimTime received;
    private uint sequence;
    private volatile bool isHealing;

    private FrameTable(bool heals)
    {
        this.heals = heals;
        SimTime start = clock.Now;
        world = new LiveWorld(BuiltInScenes.Gas(Bodies), new SimulationOptions(start, SimDuration.FromSeconds(2)));
        world.Simulation.Healed += report => healedEvents.Add(report.Events);
        nextLateEvent = start + SimDuration.FromSeconds(1.5);
    }

    internal static void Print(bool brief)
    {
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"A frame reads {Bodies:N0} bodies while {2 * Pairs} events {Late.ToMilliseconds():0} ms late are healed at a time; wall clock, p50 / p99 / max"));
        Console.WriteLine(
            "| reader | heals | events re-run by each | a heal takes, ms | asking for the render snapshot, us | reading all bodies, ms "
            + "| frames while healing: the same, us | the same, ms "
            + "| render snapshots | torn | frames in which the render snapshot ends before now |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|---|---|");
        new FrameTable(heals: true).Measure(60, brief ? 0.1 : 2.5);
        foreach (int rate in brief ? new[] { 60 } : new[] { 60, 0 })
        {
            foreach (bool heals in new[] { false, true })
            {
                Console.WriteLine(new FrameTable(heals).Measure(rate, brief ? 2 : 15));
            }
        }
    }

    private SimDuration Step()
    {
        SimTime now = clock.Now;
        if (heals && !isHealing && now >= nextLateEvent)
        {
            isHealing = true;
            received = now;
            for (int i = 0; i < Pairs; i++)
            {
                int first = random.Next(Bodies);
                int second = (first + 1 + random.Next(Bodies - 1)) % Bodies;
                SimTime stamp = now - Late + SimDuration.FromTicks((long)(random.NextDouble() * Late.Ticks / 10));
                Vector3D kick = new(0.02, 0.01, 0);
                world.Submit(ExternalEvent.Impulse(stamp, 1, ++sequence, BodyId.OfScene(first), kick));
                world.Submit(ExternalEvent.Impulse(stamp, 1, ++sequence, BodyId.OfScene(second), -kick));
            }
        }

        SimTime due = world.Step(clock.Now);
        if (isHealing && !world.IsBehind)
        {
            healMilliseconds.Add((clock.Now - received).ToMilliseconds());
            nextLateEvent = received + Between;
            isHealing = false;
        }

        due = heals ? SimTime.Min(due, SimTime.Max(nextLateEvent, clock.Now)) : due;
        return due == SimTime.MaxValue ? SimDuration.MaxValue : due - clock.Now;
    }

    /// <summary>Reads so many frames a second, or as many as it can if that is zero, for so many seconds.</summary>
    private string Measure(int rate, double seconds)
    {
        using WorldThread thread = new("world", Step);
        thread.Start();
        List<double>[] asking = { new(), new() }, reading = { new(), new() };
        long torn = 0, frames = 0, behind = 0, snapshots = 0, last = 0;
        Vector3D total = default;
        Thread.Sleep(500);
        long end = Stopwatch.GetTimestamp() + (long)(seconds * Stopwatch.Frequency);
        while (Stopwatch.GetTimestamp() < end)
        {
            thread.ThrowIfFaulted();
            int healing = isHealing ? 1 : 0;
            SimTime now = clock.Now;
            long began = Stopwatch.GetTimestamp();
            RenderSnapshot snapshot = world.RenderSnapshots.Latest();
            long asked = Stopwatch.GetTimestamp();
            SimTime time = SimTime.Min(now, snapshot.To);
            Vector3D sum = Vector3D.Zero;
            int there = 0;
            for (int n = 0; n < snapshot.BodyCount; n++)
            {
                there += snapshot.TryRead(snapshot.BodyAt(n), time, out BodyState state) ? 1 : 0;
                sum += state.Velocity;
            }

            long read = Stopwatch.GetTimestamp();
            total = frames == 0 ? sum : total;
            torn += there == Bodies && (sum - total).Length < Tolerance && snapshot.Number >= last ? 0 : 1;
            snapshots += snapshot.Number > last ? 1 : 0;
            last = snapshot.Number;
            behind += snapshot.To < now ? 1 : 0;
            frames++;
            asking[healing].Add(Stopwatch.GetElapsedTime(began, asked).TotalMicroseconds);
            reading[healing].Add(Stopwatch.GetElapsedTime(asked, read).TotalMilliseconds);
            if (rate > 0)
            {
                Thread.Sleep(1_000 / rate);
            }
        }

        thread.Dispose();
        thread.ThrowIfFaulted();
        string often = rate == 0 ? "at full speed" : $"{rate} Hz";
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {often} | {healMilliseconds.Count} | {MeanAndTail.Of(healedEvents).Mean:N0} | {Text(healMilliseconds)} | {Text(asking[0])} | {Text(reading[0])} | {Text(asking[1])} | {Text(reading[1])} "
            + $"| {snapshots:N0} | {torn} | {behind:N0} of {frames:N0} |");
    }

    private static string Text(List<double> values)
    {
        Percentiles p = Percentiles.Of(values);
        return values.Count == 0 ? "" : string.Create(CultureInfo.InvariantCulture, $"{p.P50:0.00} / {p.P99:0.00} / {p.Max:0.00}");
    }
}
