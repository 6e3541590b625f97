using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Harm;

namespace LagSim.Cli.Output;

/// <summary>Attacks, and the cost of honest players, as text.</summary>
internal static class HarmText
{
    /// <summary>Returns the command that plays only one attack.</summary>
    internal static string Replay(HarmCase drawn, bool hasProcesses = false) =>
        string.Create(CultureInfo.InvariantCulture, $"lagsim harm --attacks 1 --seed {drawn.Seed}{(hasProcesses ? " --processes 1" : "")}");

    internal static void Write(
        TextWriter output, IReadOnlyList<HarmOutcome> outcomes, IReadOnlyList<HarmOutcome> worst, IReadOnlyList<HarmProcessOutcome> played, IReadOnlyList<HonestCost> costs,
        IReadOnlyList<StarvedOutcome> starved)
    {
        if (outcomes.Count > 0)
        {
            WriteAttacks(output, outcomes, worst);
        }

        foreach (HarmProcessOutcome o in played)
        {
            output.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"with processes: {o.LateSeconds * 1000:0} ms late at most{(o.IsGood ? "" : ", NOT GOOD")}: {Replay(o.Case, hasProcesses: true)} {string.Join(" ", o.Failures.Prepend(o.Sentence))}").TrimEnd());
        }

        if (starved.Count > 0)
        {
            WriteStarved(output, starved);
        }

        if (costs.Count > 0)
        {
            output.WriteLine("honest players, 4 in each scene, 30 s:");
            output.WriteLine("scene         events  work/s  most at once  part of budget");
            foreach (HonestCost c in costs)
            {
                output.WriteLine(string.Create(
                    CultureInfo.InvariantCulture,
                    $"{c.Scene,-12} {c.Events,7} {c.WorkPerSecond,7:0} {c.PeakWork,13:0} {c.Part * 100,13:0.00} %{(c.Expelled > 0 ? "  DISCONNECTED" : "")}"));
            }
        }
    }

    private static void WriteStarved(TextWriter output, IReadOnlyList<StarvedOutcome> starved)
    {
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture, $"honest players with a starved host: all stayed in {starved.Count(o => o.IsGood)} of {NumberText.Count(starved.Count, "session")}"));
        output.WriteLine("the host                           sessions  all stayed  actions  latest");
        foreach (IGrouping<string, StarvedOutcome> kind in starved.GroupBy(o => o.Case.Starvation).OrderBy(g => g.Key))
        {
            output.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"{kind.Key,-34} {kind.Count(),8} {kind.Count(o => o.IsGood),11} {kind.Sum(o => o.Accepted),8} {kind.Max(o => o.LateSeconds) * 1000,4:0} ms"));
        }

        foreach (StarvedOutcome o in starved.Where(o => !o.IsGood))
        {
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"  lagsim harm --attacks 0 --starved 1 --seed {o.Case.Seed}: {o.Case}: {string.Join(" ", o.Failures)}"));
        }
    }

    private static void WriteAttacks(TextWriter output, IReadOnlyList<HarmOutcome> outcomes, IReadOnlyList<HarmOutcome> worst)
    {
        Percentiles late = Percentiles.Of(outcomes.Select(o => o.LateSeconds * 1000));
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{NumberText.Count(outcomes.Count, "attack")}: the player disconnected in {outcomes.Count(o => o.IsExpelled)};"
                + $" worlds later than 250 ms in {outcomes.Count(o => o.LateSeconds > 0.25)}"));
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"the latest of the others' worlds: {late.P50:0} ms at the median, {late.P99:0} ms at the 99th percentile, {late.Max:0} ms at most; out after"
                + $" {outcomes.Max(o => o.OutSeconds ?? 0):0.00} s at most, back after {outcomes.Max(o => o.BackSeconds ?? 0):0.00} s more;"
                + $" an honest player used {outcomes.Max(o => o.HonestPart) * 100:0} % of its budget at most"));
        output.WriteLine("kind           attacks        out  over 250 ms  latest");
        foreach (IGrouping<HarmKind, HarmOutcome> kind in outcomes.GroupBy(o => o.Case.Kind).OrderBy(g => g.Key))
        {
            output.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"{kind.Key,-14} {kind.Count(),7} {kind.Count(o => o.IsExpelled),10} {kind.Count(o => o.LateSeconds > 0.25),12} {kind.Max(o => o.LateSeconds) * 1000,4:0} ms"));
        }

        foreach (HarmOutcome o in worst)
        {
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"  {o.LateSeconds * 1000:0} ms{(o.IsGood ? "" : ", NOT GOOD")}: {o.Case}; {Replay(o.Case)}"));
        }

        HarmOutcome[] bad = [.. outcomes.Where(o => !o.IsGood)];
        output.WriteLine(bad.Length == 0 ? "All of them are as they should be." : $"Not as they should be: {bad.Length} of {outcomes.Count}:");
        foreach (HarmOutcome o in bad)
        {
            output.WriteLine($"  {Replay(o.Case)}: {string.Join(" ", o.Failures)} {o.Sentence}".TrimEnd());
        }
    }
}
