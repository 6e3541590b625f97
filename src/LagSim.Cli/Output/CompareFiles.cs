using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>
/// A comparison as files: the plan, a row for each run, the samples and a chart of each link, and a page that shows them.
/// </summary>
internal static class CompareFiles
{
    internal static void Write(string folder, IReadOnlyList<CompareRun> runs)
    {
        Directory.CreateDirectory(folder);
        CompareOptions options = runs[0].Options;
        HtmlReport report = new(
            $"LagSim: strategies on {options.Scene.Name}",
            CompareTables.Introduction(options) + ".",
            new ReportFooter("lagsim", ToolVersion.Text, options.Seed, JsonDocumentWriter.Hash(options.Scene.Hash)));
        report.AddTable(new ReportTable(
            "Every strategy on every link", ["link", "strategy", .. CompareTables.Columns],
            runs.Select(IReadOnlyList<string> (run) => [run.Options.Link.Name, run.Options.Strategy, .. CompareTables.Row(run)]).ToList()));
        foreach (string line in CompareTables.Footnotes(runs))
        {
            report.AddParagraph(line);
        }

        Plan(Path.Combine(folder, "compare-plan.csv"), options);
        Runs(Path.Combine(folder, "compare.csv"), runs);
        IGrouping<string, CompareRun>[] links = runs.GroupBy(run => run.Options.Link.Name).ToArray();
        if (links.Length > 1)
        {
            Chart("every link", "compare.svg", CompareChart.OfLinks(runs));
        }

        foreach (IGrouping<string, CompareRun> link in links)
        {
            Chart(link.Key, $"compare-{link.Key}.svg", CompareChart.OfLink([.. link]));
            Samples(Path.Combine(folder, $"compare-{link.Key}.csv"), link);
        }

        report.Save(Path.Combine(folder, "report.html"));

        void Chart(string heading, string name, LineChart chart)
        {
            chart.Save(Path.Combine(folder, name));
            report.AddHeading(heading).AddChart(chart);
        }
    }

    private static void Plan(string path, CompareOptions options)
    {
        using StreamWriter file = new(path);
        CsvFile csv = new(
            file, "time_s", "peer", "kind", "body", "x_m", "y_m", "z_m", "vx_m_per_s_or_n_s", "vy_m_per_s_or_n_s", "vz_m_per_s_or_n_s", "radius_m", "mass_kg", "restitution");
        foreach (PlannedAction action in options.Plan)
        {
            bool isPlaced = action.Kind is Events.EventKind.Teleport or Events.EventKind.Spawn;
            bool isNew = action.Kind == Events.EventKind.Spawn;
            csv.WriteRow(
                action.Time.ToSeconds(), action.Peer, CompareJson.KindOf(action), CompareJson.BodyOf(options.Scene, action),
                isPlaced ? action.Position.X : null, isPlaced ? action.Position.Y : null, isPlaced ? action.Position.Z : null,
                action.Velocity.X, action.Velocity.Y, action.Velocity.Z,
                isNew ? action.Spec.Radius : null, isNew ? action.Spec.Mass : null, isNew ? action.Spec.Restitution : null);
        }
    }

    private static void Runs(string path, IReadOnlyList<CompareRun> runs)
    {
        using StreamWriter file = new(path);
        CsvFile csv = new(
            file, "profile", "strategy", "seen_during_max_m", "seen_during_rms_m", "seen_after_max_m", "seen_after_rms_m", "seen_from_truth_after_max_m",
            "settled_differing_bits", "time_to_heal_p50_ms", "time_to_heal_p99_ms", "time_to_heal_max_ms", "events_rerun_mean", "events_rerun_p99", "cone_bodies_mean", "cone_bodies_p99",
            "corrections_seen", "corrections_seen_p50_m", "corrections_seen_p99_m", "corrections_seen_max_m", "event_lateness_max_ms", "divergence_max_ms", "input_latency_p50_ms",
            "bytes_sent_max_per_s");
        foreach (CompareRun run in runs)
        {
            ErrorStatistics during = run.Seen.During.ToStatistics(), after = run.Seen.After.ToStatistics();
            long differing = new[] { run.Settled.Before, run.Settled.During, run.Settled.After }.Sum(phase => phase.ToStatistics().DifferingBits);
            csv.WriteRow(
                run.Options.Link.Name, run.Options.Strategy, during.MaxMetres, during.RmsMetres, after.MaxMetres, after.RmsMetres, run.SeenFromTruth.After.ToStatistics().MaxMetres,
                differing, run.TimeToHeal.P50, run.TimeToHeal.P99, run.TimeToHeal.Max, run.EventsRerun.Mean, run.EventsRerun.P99, run.ConeBodies.Mean, run.ConeBodies.P99,
                run.CorrectionsSeen, run.Corrections.P50, run.Corrections.P99, run.Corrections.Max, run.Lateness.Max, run.Divergence.Max, run.InputLatency.P50,
                run.BytesSentPerSecond.Max());
        }
    }

    private static void Samples(string path, IEnumerable<CompareRun> runs)
    {
        using StreamWriter file = new(path);
        CsvFile csv = new(file, "strategy", "time_s", "seen_error_m", "seen_from_truth_m", "settled_error_m");
        foreach (CompareRun run in runs)
        {
            for (int n = 0; n < run.Trace.Seconds.Length; n++)
            {
                csv.WriteRow(run.Options.Strategy, run.Trace.Seconds[n], run.Trace.SeenError[n], run.Trace.SeenFromTruth[n], run.Trace.SettledError[n]);
            }
        }
    }
}
