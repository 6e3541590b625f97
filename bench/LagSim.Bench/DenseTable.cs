using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Bench;

/// <summary>What a late event costs where everything touches everything soon: the cone grows to all bodies, and a full rollback would do as well.</summary>
internal static class DenseTable
{
    private const int Bodies = 512;
    private const double Fraction = 0.5;
    private const double History = 1;

    internal static void Print(bool brief)
    {
        GasWorld cones = new(Bodies, Fraction, HealingMode.CausalCone, History);
        GasWorld fulls = new(Bodies, Fraction, HealingMode.FullRollback, History);
        cones.Bring(brief ? 1 : 10, 0.1, 0.01); // so that nothing is measured that the compiler has not finished with
        fulls.Bring(brief ? 1 : 10, 0.1, 0.01);
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"One late event, {Bodies:N0} bodies at volume fraction {Fraction}, {cones.ContactsPerSecond:0} contacts a second each; {ThreadClock.Name} of the thread, p50"));
        Console.WriteLine("| late, ms | cone: share of the bodies | events re-run | time, ms | full rollback: events | time, ms | time, cone : full |");
        Console.WriteLine("|---|---|---|---|---|---|---|");
        foreach (double late in brief ? new[] { 0.2 } : new[] { 0.05, 0.1, 0.2, 0.3, 0.4, 0.6 })
        {
            int count = brief ? 1 : 7;
            IReadOnlyList<GasWorld.Heal> cone = cones.Bring(count, late, 0.125);
            IReadOnlyList<GasWorld.Heal> full = fulls.Bring(count, late, 0.125);
            double coneTime = Percentiles.Of(cone.Select(h => h.Microseconds)).P50 / 1000;
            double fullTime = Percentiles.Of(full.Select(h => h.Microseconds)).P50 / 1000;
            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"| {late * 1000:0} | {cone.Average(h => h.Bodies) / Bodies:P1} | {GasWorld.Heal.MeanEvents(cone):N0} | {coneTime:0.0} | {GasWorld.Heal.MeanEvents(full):N0} | {fullTime:0.0} | {coneTime / fullTime:0.00} |"));
        }
    }
}
