using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Stalls;

namespace LagSim.Cli.Output;

/// <summary>Sessions with stalls as text.</summary>
internal static class StallsText
{
    /// <summary>Returns the command that plays only one session.</summary>
    internal static string Replay(StallCase drawn, bool hasProcesses = false) =>
        string.Create(CultureInfo.InvariantCulture, $"lagsim stalls --sessions 1 --seed {drawn.Seed}{(hasProcesses ? " --processes 1" : "")}");

    /// <summary>
    /// Returns the number of refused events, and why, where the link is the reason: else "0 of 0 lost" on a slow link would have no
    /// explanation.
    /// </summary>
    private static string Refused(IReadOnlyList<StallOutcome> outcomes)
    {
        long refused = outcomes.Sum(o => o.Refused), late = outcomes.Sum(o => o.RefusedTooLate);
        string why = refused == 0 ? "" : late == refused ? " (they came too late)" : string.Create(CultureInfo.InvariantCulture, $" ({late} of them came too late)");
        return string.Create(CultureInfo.InvariantCulture, $"{refused} refused{why}");
    }

    private static string Lost(IReadOnlyList<StallOutcome> outcomes) => string.Create(
        CultureInfo.InvariantCulture,
        $"{NumberText.Count(outcomes.Sum(o => o.Accepted), "event")} accepted, {outcomes.Sum(o => o.Lost)} of {outcomes.Sum(o => o.Expected)} lost on the way to clients,"
            + $" {Refused(outcomes)}");

    internal static void Write(
        TextWriter output, IReadOnlyList<StallOutcome> outcomes, IReadOnlyList<StallOutcome> worst, IReadOnlyList<StallProcessOutcome> played)
    {
        Percentiles recovery = Percentiles.Of(outcomes.SelectMany(o => o.RecoverySeconds));
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{NumberText.Count(outcomes.Count, "session")}, {NumberText.Count(outcomes.Sum(o => o.Case.Stalls.Count), "stall")}:"
                + $" {outcomes.Sum(o => o.Compared)} states compared, {outcomes.Sum(o => o.Differed)} differ;"
                + $" {Lost(outcomes)};"
                + $" {NumberText.Count(outcomes.Sum(o => o.Copies), "fresh copy", many: "fresh copies")},"
                + $" {NumberText.Count(outcomes.Sum(o => o.Regained), "interruption")} that ended without one"));
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"up to date after the end of a stall: {recovery.P50:0.00} s at the median, {recovery.P99:0.0} s at the 99th percentile, {recovery.Max:0.0} s at most"));
        foreach (StallOutcome o in worst)
        {
            output.WriteLine(string.Create(
                CultureInfo.InvariantCulture, $"  {o.WorstSeconds:0.0} s{(o.IsGood ? "" : ", NOT GOOD")}: {o.Case}"));
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"    {Lost([o])}"));
            output.WriteLine($"    {Replay(o.Case)}");
        }

        StallOutcome[] bad = [.. outcomes.Where(o => !o.IsGood)];
        output.WriteLine(bad.Length == 0 ? "All of them are as they should be." : $"Not as they should be: {bad.Length} of {outcomes.Count}:");
        foreach (StallOutcome o in bad)
        {
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"  {Replay(o.Case)}: {o.Differed} states differ, {o.Lost} events lost. {string.Join(" ", o.Failures)}"));
        }

        foreach (StallProcessOutcome o in played)
        {
            output.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"with processes: {o.Compared} states compared, {o.Differed} differ{(o.IsGood ? "" : ", NOT GOOD")}: {Replay(o.Case, hasProcesses: true)} {string.Join(" ", o.Failures)}").TrimEnd());
        }
    }
}
