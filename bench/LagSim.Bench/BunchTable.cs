using System;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Bench;

/// <summary>What many late events cost that come at once, as after a link was silent: healed together, one by one, and fully rolled back together.</summary>
internal static class BunchTable
{
    private const int Bodies = 2_000;
    private const double Fraction = 0.2;
    private const double History = 1;
    private const double Late = 0.9;

    internal static void Print(bool brief)
    {
        GasWorld cones = new(Bodies, Fraction, HealingMode.CausalCone, History);
        GasWorld fulls = new(Bodies, Fraction, HealingMode.FullRollback, History);
        cones.BringTogether(brief ? 1 : 10, Late); // so that nothing is measured that the compiler has not finished with
        fulls.BringTogether(brief ? 1 : 10, Late);
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"Late events that come at once, {Late * 900:0} to {Late * 1000:0} ms late in any order, {Bodies:N0} bodies at volume fraction {Fraction}; {ThreadClock.Name} of the thread, p50"));
        Console.WriteLine("| events | cone: events re-run | ms | one by one: events re-run | ms | full rollback: events re-run | ms | events, cone : full | time, cone : full |");
        Console.WriteLine("|---|---|---|---|---|---|---|---|---|");
        foreach (int count in brief ? new[] { 10 } : new[] { 1, 3, 10, 30, 100, 400 })
        {
            (double Events, double Milliseconds) cone = Usual(cones.BringTogether);
            (double Events, double Milliseconds) single = Usual((count, late) => GasWorld.Heal.Sum(cones.Bring(count, late, 0.001)));
            (double Events, double Milliseconds) full = Usual(fulls.BringTogether);
            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"| {count} | {cone.Events:N0} | {cone.Milliseconds:0.0} | {single.Events:N0} | {single.Milliseconds:0.0} | {full.Events:N0} | {full.Milliseconds:0.0} "
                + $"| {cone.Events / full.Events:0.00} | {cone.Milliseconds / full.Milliseconds:0.00} |"));

            (double Events, double Milliseconds) Usual(Func<int, double, GasWorld.Heal> bring)
            {
                GasWorld.Heal[] heals = [.. Enumerable.Range(0, brief ? 1 : 7).Select(_ => bring(count, Late))];
                return (Percentiles.Of(heals.Select(h => (double)h.Events)).P50, Percentiles.Of(heals.Select(h => h.Microseconds)).P50 / 1000);
            }
        }
    }
}
