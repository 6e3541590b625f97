using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;
using LagSim.Harness.SceneFiles;

namespace LagSim.Cli.Output;

/// <summary>A drop test as files: a CSV and an SVG for each case, one CSV of all strategies, and a page that shows them.</summary>
internal static class DropFiles
{
    internal static void Write(string folder, IReadOnlyList<DropRun> runs, IReadOnlyList<DropRun> strategies)
    {
        Directory.CreateDirectory(folder);
        DropOptions options = runs[0].Options;
        HtmlReport report = new(
            "LagSim drop test",
            $"{options.Peers} peers in {DropNames.Time(options)} time, strategy {options.Strategy}, motion {MotionNames.Of(options.Motion)}, link"
                + $" {options.Link.Name}.",
            new ReportFooter("lagsim", ToolVersion.Text, options.Seed, JsonDocumentWriter.Hash(runs[0].SceneHash)));
        report.AddFinding(DropFindings.Of(runs[^1]));
        for (int n = 0; n < runs.Count; n++)
        {
            DropRun run = runs[n];
            DropRun? before = n == 0 ? null : runs[n - 1];
            string name = DropNames.Case(run.Case);
            LineChart chart = DropChart.Of(run, before);
            chart.Save(Path.Combine(folder, $"drop-{name}.svg"));
            Samples(Path.Combine(folder, $"drop-{name}.csv"), run);
            report.AddHeading(name);
            if (n < runs.Count - 1)
            {
                report.AddParagraph(DropFindings.Of(run)); // the last case's paragraph is at the top
            }

            report.AddChart(chart);
            if (DropChart.OfEvent(run, before) is LineChart milliseconds)
            {
                report.AddChart(milliseconds, "Each mark is a sample.");
            }

            report.AddTable(ErrorTable.Of("Height error between peers, in metres", run), n == 0 ? ErrorTable.Terms : null);
        }

        if (strategies.Count > 0)
        {
            LineChart compared = DropChart.OfStrategies(strategies, runs);
            compared.Save(Path.Combine(folder, "drop-strategies.svg"));
            StrategySamples(Path.Combine(folder, "drop-strategies.csv"), strategies);
            report.AddHeading("Every strategy on the teleport case, in virtual time").AddChart(compared).AddTable(StrategyErrors(strategies));
        }

        report.Save(Path.Combine(folder, "report.html"));
    }

    private static void Samples(string path, DropRun run)
    {
        int peers = run.Trace.Heights.Length;
        string[] header =
        [
            "time_s",
            .. Enumerable.Range(0, peers).Select(p => $"seen_height_{p}_m"),
            .. Enumerable.Range(0, peers).Select(p => $"settled_height_{p}_m"),
            "seen_error_m", "seen_true_time_error_m", "settled_error_m",
        ];
        using StreamWriter file = new(path);
        CsvFile csv = new(file, header);
        for (int n = 0; n < run.Trace.Seconds.Length; n++)
        {
            csv.WriteRow(
            [
                run.Trace.Seconds[n],
                .. run.Trace.Heights.Select(h => (object?)h[n]),
                .. run.Trace.SettledHeights.Select(h => (object?)h[n]),
                run.Trace.SeenError[n], run.Trace.SeenTrueTimeError[n], run.Trace.SettledError[n],
            ]);
        }
    }

    private static void StrategySamples(string path, IReadOnlyList<DropRun> runs)
    {
        using StreamWriter file = new(path);
        CsvFile csv = new(file, "strategy", "time_s", "seen_error_m", "settled_error_m");
        foreach (DropRun run in runs)
        {
            for (int n = 0; n < run.Trace.Seconds.Length; n++)
            {
                csv.WriteRow(run.Options.Strategy, run.Trace.Seconds[n], run.Trace.SeenError[n], run.Trace.SettledError[n]);
            }
        }
    }

    private static ReportTable StrategyErrors(IReadOnlyList<DropRun> runs) =>
        new(
            "Height error in metres",
            ["strategy", "seen during, max", "seen after, max", "seen after, rms", "settled after, differing bits"],
            runs.Select(IReadOnlyList<string> (run) =>
            [
                run.Options.Strategy, NumberText.Short(run.Seen.During.ToStatistics().MaxMetres), NumberText.Short(run.Seen.After.ToStatistics().MaxMetres),
                NumberText.Short(run.Seen.After.ToStatistics().RmsMetres), $"{run.Settled.After.ToStatistics().DifferingBits}",
            ]).ToList());
}
