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

/// <summary>How long a reader sees a world without an event that came late, in real time: how late it was, what the heal takes up to the published render snapshot, and what comes on top.</summary>
internal sealed class ArrivalTable
{
    private static readonly SimDuration Late = SimDuration.FromMilliseconds(100);

    private readonly IClock clock = new StopwatchClock();
    private readonly List<double> quiet = new(); // steps without late events
    private readonly LiveWorld world;
    private uint sequence;
    private int target = -1; // the body that something is to happen to
    private SimTime arrival;
    private SimTime published;

    private ArrivalTable(int bodies) =>
        world = new LiveWorld(BuiltInScenes.Gas(bodies), new SimulationOptions(clock.Now, SimDuration.FromSeconds(1)));

    internal static void Print(bool brief)
    {
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"An event {Late.ToMilliseconds():0} ms late among bodies of a gas, real time, p50 / p99 / max in ms. Divergence: from the stamp until a reader at full speed sees the event"));
        Console.WriteLine(
            "| bodies | divergence | compute: from arrival to published render snapshot | divergence - lateness - compute | a step without late events |");
        Console.WriteLine("|---|---|---|---|---|");
        new ArrivalTable(1_000).Measure(1_000, brief ? 5 : 100); // so that nothing is measured that the compiler has not finished with
        foreach (int bodies in brief ? new[] { 1_000 } : new[] { 100, 1_000, 3_000 })
        {
            Console.WriteLine(new ArrivalTable(bodies).Measure(bodies, brief ? 10 : 500));
        }
    }

    private string Measure(int bodies, int count)
    {
        using WorldThread thread = new("world", Step);
        thread.Start();
        List<double> divergence = new(), compute = new(), rest = new();
        Random random = new(1);
        Thread.Sleep(700);
        for (int i = 0; i < count; i++)
        {
            Thread.Sleep(5 + random.Next(15));
            int number = random.Next(bodies);
            RenderSnapshot snapshot = world.RenderSnapshots.Latest();
            SimTime asked = clock.Now;
            if (!snapshot.TryRead(BodyId.OfScene(number), asked, out BodyState without))
            {
                continue; // the machine has not kept up: there is nothing to compare
            }

            Volatile.Write(ref target, number);
            thread.Wake();
            BodyState shown = without;
            while (shown.IsSameBits(without))
            {
                thread.ThrowIfFaulted();
                world.RenderSnapshots.Latest().TryRead(BodyId.OfScene(number), asked, out BodyState read);
                shown = read.Motion == MotionLaw.Absent ? without : read; // a render snapshot may end before
            }

            SimTime seen = clock.Now;
            while (Volatile.Read(ref target) >= 0)
            {
            }

            divergence.Add((seen - (arrival - Late)).ToMilliseconds());
            compute.Add((published - arrival).ToMilliseconds());
            rest.Add((seen - published).ToMilliseconds());
        }

        thread.Dispose();
        return $"| {bodies.ToString("N0", CultureInfo.InvariantCulture)} | {Text(divergence)} | {Text(compute)} | {Text(rest)} | {Text(quiet)} |";
    }

    private SimDuration Step()
    {
        int number = Volatile.Read(ref target);
        long began = Stopwatch.GetTimestamp();
        if (number >= 0)
        {
            SimTime now = clock.Now;
            world.Submit(ExternalEvent.Impulse(now - Late, 1, ++sequence, BodyId.OfScene(number), new Vector3D(0.01, 0.005, 0)));
            arrival = now;
        }

        SimTime due;
        do
        {
            due = world.Step(clock.Now);
        }
        while (world.IsBehind);
        if (number >= 0)
        {
            published = clock.Now;
            Volatile.Write(ref target, -1);
        }
        else
        {
            quiet.Add(Stopwatch.GetElapsedTime(began).TotalMilliseconds);
        }

        return due - clock.Now;
    }

    private static string Text(List<double> milliseconds)
    {
        Percentiles p = Percentiles.Of(milliseconds);
        return string.Create(CultureInfo.InvariantCulture, $"{p.P50:0.000} / {p.P99:0.000} / {p.Max:0.000}");
    }
}
