using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Reports;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>Every strategy on every link as one table for a terminal.</summary>
internal static class CompareTables
{
    /// <summary>The columns after link and strategy. Errors, distances and jumps are in metres.</summary>
    internal static IReadOnlyList<string> Columns { get; } = ["during", "after", "off truth", "heal ms", "re-run", "cone", "bytes/s", "jumps"];

    internal static void Write(ToolConsole console, IReadOnlyList<CompareRun> runs, string? folder)
    {
        CompareOptions options = runs[0].Options;
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   compare   seed {options.Seed}   scene {JsonDocumentWriter.Hash(options.Scene.Hash)}");
        console.Output.WriteLine(Introduction(options));
        Table table = DropTables.NewTable("every strategy on every link", ["link", "strategy", .. Columns]);
        foreach (CompareRun run in runs)
        {
            table.AddRow([run.Options.Link.Name, run.Options.Strategy, .. Row(run)]);
        }

        console.Write(table);
        foreach (string line in Footnotes(runs))
        {
            console.Output.WriteLine(line);
        }

        if (folder is not null)
        {
            console.Output.WriteLine($"Charts, CSV and report.html are in {folder}.");
        }
    }

    internal static string Introduction(CompareOptions options) =>
        $"{options.Scene.Name}, {options.Peers} peers, {NumberText.Count(options.Plan.Count, "event")} in"
            + $" {NumberText.Short(CompareOptions.Length.ToSeconds())} s of virtual time, the same for all";

    /// <summary>Returns the cells of a run under <see cref="Columns"/>.</summary>
    internal static string[] Row(CompareRun run) =>
    [
        NumberText.Short(run.Seen.During.ToStatistics().MaxMetres),
        NumberText.Short(run.Seen.After.ToStatistics().MaxMetres),
        NumberText.Short(run.SeenFromTruth.After.ToStatistics().MaxMetres),
        NumberText.Short(run.TimeToHeal.P99),
        NumberText.Short(run.EventsRerun.Mean),
        NumberText.Short(run.ConeBodies.Mean),
        NumberText.Short(run.BytesSentPerSecond.Max()),
        NumberText.Short(run.Corrections.Max),
    ];

    internal static IEnumerable<string> Footnotes(IReadOnlyList<CompareRun> runs)
    {
        yield return "during, after: largest distance in metres between the host's view and another peer's at the same shared time,"
            + " while an event is on its way to a peer, and while none is.";
        yield return "off truth: after the events, from a world that had all of them on time. heal ms: wall clock of the step that takes"
            + " an event in, 99th percentile.";
        yield return "re-run, cone: events re-simulated and bodies predicted anew for one late event, on average. bytes/s: the peer that"
            + " sends most. jumps: the furthest a drawn body jumped.";
        foreach (string sentence in new CompareFindings(runs).Sentences())
        {
            yield return sentence;
        }

        foreach (CompareRun broken in runs.Where(IsBroken))
        {
            yield return $"NOT equal: with {broken.Options.Strategy} on {broken.Options.Link.Name} not all peers settled on the same."
                + (broken.FirstDifference is SettledDifference first
                    ? FormattableString.Invariant($" The first body that differs is '{first.Body}', of peer {first.Peer} at T {first.Seconds} s.")
                    : " No body differs in what was sampled.");
        }
    }

    /// <summary>Whether a strategy promised agreement, and did not agree.</summary>
    internal static bool IsBroken(CompareRun run) => Net.Strategies.LateEventStrategies.Create(run.Options.Strategy).PromisesAgreement && !run.Agrees;
}
