using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using LagSim.Net.Display;
using LagSim.Net.Strategies;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>A hand that holds and throws a ball, and its prediction, as tables for a terminal.</summary>
internal static class HoldTables
{
    internal static IReadOnlyList<string> ViewHeadings { get; } = ["link", "seen by", "simulated", "max", "predicted", "max", "of best", "hold", "velocity", "own"];

    internal static IReadOnlyList<string> SessionHeadings { get; } =
        ["link", "during", "after", "settled differ", "heals", "late ms", "knots/s", "sent", "received"];

    internal static IReadOnlyList<string> Headings { get; } = ["delay", "adaptive", "of best", "best", "which is", "hold last", "velocity", "linear"];

    internal static void Write(ToolConsole console, HoldReport report, string? folder)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   hold   seed {report.Seed}   scene {JsonDocumentWriter.Hash(report.Runs[0].SceneHash)}");
        console.Output.WriteLine(Introduction(report));
        WriteTable(console, ViewTitle, ViewHeadings, Views(report.Runs));
        WriteTable(console, SessionTitle, SessionHeadings, Sessions(report.Runs));
        foreach (string line in Footnotes(report))
        {
            console.Output.WriteLine(line);
        }

        WriteTable(console, PredictionTitle, Headings, report.Predictions.Select(Row));
        console.Output.WriteLine(PredictionFootnote);
        if (folder is not null)
        {
            console.Output.WriteLine($"Charts, CSV and report.html are in {folder}.");
        }
    }

    internal const string ViewTitle = "the ball in the hand, off from where the hand is then: rms and largest error in mm";

    internal const string SessionTitle = "the sessions: error between the peers as seen, m; bytes/s of the holder";

    internal const string PredictionTitle = "the hand predicted from all of its samples, by delay in ms: rms error in mm";

    internal const string PredictionFootnote = "best: of what the adaptive one mixes, in hindsight; linear: 20 taps, fitted to the other nine tenths of this"
        + " very motion";

    internal static string Introduction(HoldReport report)
    {
        HoldOptions options = report.Runs[0].Options;
        string time = options.IsVirtual ? "virtual time" : $"real time over {options.Carrier}, {options.Link.Name} alone";
        string hand = FormattableString.Invariant($"{report.Motion.Name} motion of a hand, {report.Motion.Seconds:0.#} s, at most {NumberText.Short(report.Motion.LargestAcceleration())} m/s^2");
        return FormattableString.Invariant($"{hand}; {options.Strategy}, {options.Peers} peers, the ball is held for {options.HoldSeconds:0.##} s and thrown, {time}");
    }

    internal static IEnumerable<string> Footnotes(HoldReport report)
    {
        yield return "simulated: where that peer's world has the ball, by the last keyframe; predicted: drawn where the adaptive predictor tells the hand is,"
            + " from the same keyframes.";
        yield return "of best: its rms error over that of the best in hindsight of what it mixes; hold, velocity: two of those; own: what the holder sees,"
            + " which keyframes leave out.";
        yield return $"A keyframe goes out when the others are off by more than {NumberText.Short(1000 * report.Runs[0].Options.KeyframeDistanceMetres)} mm. The"
            + " throw is not in these errors.";
        yield return "during: while an event of the hand is on its way to a peer, after: while none is. Bytes while it holds,"
            + " with UDP and IP headers.";
        yield return "The thesis's own figures for this (Fig 4 and 5) are not known to this tool.";
        foreach (HoldRun broken in report.Runs.Where(run => !run.Agrees))
        {
            yield return $"NOT equal: with {broken.Options.Strategy} on {broken.Options.Link.Name} not all peers settled on the world that had all on time.";
        }
    }

    /// <summary>Returns a row for each link and each watching peer.</summary>
    internal static IEnumerable<IReadOnlyList<string>> Views(IReadOnlyList<HoldRun> runs) => runs.SelectMany(run => run.Views.Select(view => new[]
    {
        run.Options.Link.Name, PeerName(view.Peer), Millimetres(view.Simulated.RmsMetres), Millimetres(view.Simulated.MaxMetres), Predicted(view, view.Predicted.RmsMetres),
        Predicted(view, view.Predicted.MaxMetres), Ratio(view.RatioToBest), Predicted(view, view.HoldLastMetres), Predicted(view, view.VelocityMetres), Millimetres(run.Own.RmsMetres),
    }));

    private static string Predicted(HeldView view, double metres) => view.Predicted.Samples == 0 ? "-" : Millimetres(metres);

    /// <summary>Returns a row for each link.</summary>
    internal static IEnumerable<IReadOnlyList<string>> Sessions(IReadOnlyList<HoldRun> runs) => runs.Select(run =>
    {
        ErrorStatistics[] settled = [run.Settled.Before.ToStatistics(), run.Settled.During.ToStatistics(), run.Settled.After.ToStatistics()];
        return new[]
        {
            run.Options.Link.Name, NumberText.Short(run.Seen.During.ToStatistics().MaxMetres), NumberText.Short(run.Seen.After.ToStatistics().MaxMetres),
            FormattableString.Invariant($"{settled.Sum(e => e.DifferingBits)} of {settled.Sum(e => e.Samples)}"),
            FormattableString.Invariant($"{run.Heals}"), NumberText.Short(run.Lateness.Max), NumberText.Short(run.KeyframesPerSecond),
            FormattableString.Invariant($"{run.HolderSentPerSecond:0}"), FormattableString.Invariant($"{run.HolderReceivedPerSecond:0}"),
        };
    });

    internal static IReadOnlyList<string> Row(PredictionError error) =>
    [
        NumberText.Short(error.HorizonMilliseconds), Millimetres(error.AdaptiveMetres), error.BestInHindsightMetres > 0 ? Ratio(error.RatioToBest) : "-",
        Millimetres(error.BestInHindsightMetres), error.BestInHindsightMetres > 0 ? AdaptivePredictor.Candidates[error.BestCandidate] : "-",
        Millimetres(error.HoldLastMetres), Millimetres(error.VelocityMetres), Millimetres(error.LinearMetres),
    ];

    /// <summary>Whether a strategy promised agreement, and did not agree.</summary>
    internal static bool IsBroken(HoldRun run) => LateEventStrategies.Create(run.Options.Strategy).PromisesAgreement && !run.Agrees;

    internal static string PeerName(int place) => place == 0 ? "host" : string.Create(CultureInfo.InvariantCulture, $"client {place}");

    private static string Ratio(double ratio) => double.IsFinite(ratio) ? ratio.ToString("0.000", CultureInfo.InvariantCulture) : "-";

    private static string Millimetres(double metres) => NumberText.Short(1000 * metres);

    private static void WriteTable(ToolConsole console, string title, IReadOnlyList<string> headings, IEnumerable<IReadOnlyList<string>> rows)
    {
        Table table = DropTables.NewTable(title, [.. headings]);
        foreach (IReadOnlyList<string> row in rows)
        {
            table.AddRow([.. row]);
        }

        console.Write(table);
    }
}
