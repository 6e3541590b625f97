using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>Collisions a second of one thread in a fluid of hard spheres, the measure of event-driven codes since Alder and Wainwright.</summary>
internal static class HardSphereTable
{
    private const int Repeats = 5;

    private static readonly SimDuration Window = SimDuration.FromMilliseconds(250);
    private static readonly SimDuration Shortest = SimDuration.OneTick;

    internal static void Print(bool brief)
    {
        new HardSpheres(1_000, 0.25, Window, brief ? 20 : 200); // so that nothing is measured that the compiler has not finished with
        Console.WriteLine($"Hard spheres, elastic, periodic box, one thread; {ThreadClock.Name} of the thread, median and best of {Repeats}");
        Console.WriteLine(
            "| bodies | fraction | history | collisions a second each: measured / Enskog | segments kept each "
            + "| collisions a second, median / best | us each | events : collisions | bytes allocated |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|");
        foreach (int bodies in brief ? new[] { 1_000 } : new[] { 1_000, 4_000, 32_000 })
        {
            foreach (double fraction in new[] { 0.25, 0.49 })
            {
                foreach (SimDuration history in new[] { Window, Shortest })
                {
                    Console.WriteLine(Row(bodies, fraction, history, brief));
                }
            }
        }
    }

    private static string Row(int bodies, double fraction, SimDuration history, bool brief)
    {
        HardSpheres fluid = new(bodies, fraction, history, brief ? 20 : 100);
        List<double> rates = new();
        SimTime begin = fluid.Simulation.SimulatedTo;
        long events = fluid.Simulation.EventsProcessed;
        long collisions = 0;
        long allocated = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < Repeats; i++)
        {
            double began = ThreadClock.Microseconds;
            long happened = fluid.Collide(brief ? 10 : Math.Max(20, 400_000 / bodies));
            rates.Add(happened / (ThreadClock.Microseconds - began) * 1e6);
            collisions += happened;
        }

        allocated = GC.GetAllocatedBytesForCurrentThread() - allocated;
        events = fluid.Simulation.EventsProcessed - events;
        double each = 2 * collisions / (bodies * (fluid.Simulation.SimulatedTo - begin).ToSeconds());
        rates.Sort();
        double median = rates[Repeats / 2];
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {bodies:N0} | {fraction} | {(history == Shortest ? "a tick" : "250 ms")} | {each:0.00} / {fluid.EnskogRate:0.00} "
            + $"| {fluid.Simulation.Engine.Timelines.Alive / (double)bodies:0.0} "
            + $"| {median:N0} / {rates.Max():N0} | {1e6 / median:0.00} | {events / (double)collisions:0.00} | {allocated:N0} |");
    }
}
