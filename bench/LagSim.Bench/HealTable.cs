using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Bench;

/// <summary>What one event 100 ms late costs among few and among many bodies at equal density, the causal cone beside full rollback.</summary>
internal static class HealTable
{
    private const double Fraction = 0.2;
    private const double Late = 0.1;
    private const double History = 0.5;

    internal static void Print(bool brief)
    {
        Warm(brief);
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"One event {Late * 1000:0} ms late, periodic box at volume fraction {Fraction}; {ThreadClock.Name} of the thread"));
        Console.WriteLine(
            "| bodies | contacts a second each | cone: bodies | events re-run, mean / p99 | impacts, mean | time p50 / p99, us | full rollback: events, mean / p99 | time p50 / p99, us | events, full : cone | time p50, full : cone |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|---|");
        List<IReadOnlyList<GasWorld.Heal>> cones = new();
        foreach (int bodies in brief ? new[] { 100, 1_000 } : new[] { 100, 1_000, 10_000, 100_000 })
        {
            GasWorld world = new(bodies, Fraction, HealingMode.CausalCone, History);
            IReadOnlyList<GasWorld.Heal> cone = world.Bring(brief ? 100 : 2_000, Late, bodies > 10_000 ? 0.0003 : 0.002);
            cones.Add(cone);

            // Far apart in time, so that none finds what the one before left in the index.
            int times = brief ? 3 : bodies switch { <= 1_000 => 100, 10_000 => 20, _ => 3 };
            IReadOnlyList<GasWorld.Heal> full = new GasWorld(bodies, Fraction, HealingMode.FullRollback, History).Bring(times, Late, 0.125);
            Console.WriteLine(Row(bodies, world.ContactsPerSecond, cone, full));
        }

        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"From the fewest to the most bodies: events re-run x {Ratio(cones, h => h.Events):0.00}, impacts x {Ratio(cones, h => h.Impacts):0.00}, time p50 x {P50(cones[^1]) / P50(cones[0]):0.00}"));
    }

    /// <summary>So that nothing is measured that the compiler has not finished with.</summary>
    private static void Warm(bool brief)
    {
        foreach (HealingMode mode in new[] { HealingMode.CausalCone, HealingMode.FullRollback })
        {
            new GasWorld(1_000, Fraction, mode, History).Bring(brief ? 5 : mode == HealingMode.CausalCone ? 3_000 : 30, Late, 0.001);
        }
    }

    private static double P50(IReadOnlyList<GasWorld.Heal> heals) => Percentiles.Of(heals.Select(h => h.Microseconds)).P50;

    private static double Ratio(List<IReadOnlyList<GasWorld.Heal>> cones, Func<GasWorld.Heal, double> of) => cones[^1].Average(of) / cones[0].Average(of);

    private static string Row(int bodies, double contacts, IReadOnlyList<GasWorld.Heal> cone, IReadOnlyList<GasWorld.Heal> full)
    {
        MeanAndTail coneEvents = MeanAndTail.Of(cone.Select(h => (double)h.Events).ToArray());
        MeanAndTail fullEvents = MeanAndTail.Of(full.Select(h => (double)h.Events).ToArray());
        Percentiles coneTime = Percentiles.Of(cone.Select(h => h.Microseconds));
        Percentiles fullTime = Percentiles.Of(full.Select(h => h.Microseconds));
        return string.Create(
            CultureInfo.InvariantCulture,
            $"| {bodies:N0} | {contacts:0.0} | {cone.Average(h => h.Bodies):0.0} | {coneEvents.Mean:0.00} / {coneEvents.P99:0} | {cone.Average(h => (double)h.Impacts):0.00} | {coneTime.P50:0} / {coneTime.P99:0} "
            + $"| {fullEvents.Mean:N0} / {fullEvents.P99:N0} | {fullTime.P50:N0} / {fullTime.P99:N0} | {fullEvents.Mean / coneEvents.Mean:N0} | {fullTime.P50 / coneTime.P50:N0} |");
    }
}
