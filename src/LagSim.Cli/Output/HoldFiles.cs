using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;
using LagSim.Net.Display;
using LagSim.Scenes;

namespace LagSim.Cli.Output;

/// <summary>
/// The files of a hand that holds and throws a ball: a row for each link, its samples and two charts, the errors by delay, the prediction,
/// and a page that shows all.
/// </summary>
internal static class HoldFiles
{
    /// <summary>Returns the result in one sentence.</summary>
    internal static string Finding(IReadOnlyList<HoldRun> runs)
    {
        long differing = runs.SelectMany(run => new[] { run.Settled.Before, run.Settled.During, run.Settled.After })
            .Sum(phase => phase.ToStatistics().DifferingBits);
        return differing == 0 ? "Once every event had arrived, no bit differed between the peers at any delay."
            : $"Once every event had arrived, {NumberText.Count(differing, "sample", "N0")} still differed between the peers.";
    }

    internal static void Write(string folder, HoldReport report)
    {
        Directory.CreateDirectory(folder);
        HandMotion motion = report.Motion;
        HtmlReport page = new(
            "LagSim: a hand holds and throws a ball",
            HoldTables.Introduction(report) + ".",
            new ReportFooter("lagsim", ToolVersion.Text, report.Seed, JsonDocumentWriter.Hash(report.Runs[0].SceneHash)));
        page.AddFinding(Finding(report.Runs));
        page.AddTable(new ReportTable(HoldTables.ViewTitle, HoldTables.ViewHeadings, HoldTables.Views(report.Runs).ToList()))
            .AddTable(new ReportTable(HoldTables.SessionTitle, HoldTables.SessionHeadings, HoldTables.Sessions(report.Runs).ToList()));
        foreach (string line in HoldTables.Footnotes(report))
        {
            page.AddParagraph(line);
        }

        Runs(Path.Combine(folder, "hold.csv"), report.Runs);
        if (report.Runs.Count > 1)
        {
            page.AddHeading("What delay does");
            Chart("hold-delays.svg", HoldChart.OfDelays(report));
            Chart("hold-views.svg", HoldChart.OfViews(motion, report.Runs));
        }

        foreach (HoldRun run in report.Runs)
        {
            string name = run.Options.Link.Name;
            Samples(Path.Combine(folder, $"hold-{name}.csv"), run);
            page.AddHeading(name);
            Chart($"hold-{name}.svg", HoldChart.OfHold(motion, run));
            Chart($"hold-{name}-throw.svg", HoldChart.OfThrow(motion, run));
            page.AddTable(ErrorTable.Of("Error between peers, in metres", run), run == report.Runs[0] ? ErrorTable.Terms : null);
        }

        page.AddHeading("How well this hand can be predicted from all of its samples");
        Chart("hold-prediction.svg", HoldChart.OfErrors(motion, report.Predictions));
        page.AddTable(new ReportTable(HoldTables.PredictionTitle, HoldTables.Headings, report.Predictions.Select(HoldTables.Row).ToList())).AddParagraph(HoldTables.PredictionFootnote);
        Chart("hold-motion.svg", HoldChart.OfMotion(motion));
        Errors(Path.Combine(folder, "hold-prediction.csv"), report.Predictions);
        page.Save(Path.Combine(folder, "report.html"));

        void Chart(string file, LineChart chart)
        {
            chart.Save(Path.Combine(folder, file));
            page.AddChart(chart);
        }
    }

    /// <summary>Writes a row for each link and watching peer.</summary>
    private static void Runs(string path, IReadOnlyList<HoldRun> runs)
    {
        using StreamWriter file = new(path);
        CsvFile csv = new(
            file, "profile", "strategy", "peer", "simulated_rms_m", "simulated_max_m", "predicted_rms_m", "predicted_max_m", "best_in_hindsight_m", "hold_last_m", "velocity_m",
            "holder_rms_m", "seen_during_max_m", "seen_after_max_m", "settled_differing_bits", "heals", "event_lateness_max_ms", "knots_per_s", "holder_bytes_sent_per_s",
            "holder_bytes_received_per_s");
        foreach (HoldRun run in runs)
        {
            long differing = new[] { run.Settled.Before, run.Settled.During, run.Settled.After }.Sum(phase => phase.ToStatistics().DifferingBits);
            ErrorStatistics during = run.Seen.During.ToStatistics(), after = run.Seen.After.ToStatistics();
            foreach (HeldView view in run.Views)
            {
                csv.WriteRow(
                    run.Options.Link.Name, run.Options.Strategy, view.Peer, view.Simulated.RmsMetres, view.Simulated.MaxMetres, view.Predicted.RmsMetres, view.Predicted.MaxMetres,
                    view.BestInHindsightMetres, view.HoldLastMetres, view.VelocityMetres, run.Own.RmsMetres, during.MaxMetres, after.MaxMetres, differing, run.Heals, run.Lateness.Max,
                    run.KeyframesPerSecond, run.HolderSentPerSecond, run.HolderReceivedPerSecond);
            }
        }
    }

    /// <summary>
    /// The samples: where the hand was, where each peer showed the ball, and where the predictor would have drawn it for the other peers.
    /// </summary>
    private static void Samples(string path, HoldRun run)
    {
        HoldTrace trace = run.Trace;
        using StreamWriter file = new(path);
        CsvFile csv = new(
            file,
            [
                "time_s", .. Columns("hand"), .. trace.Balls.SelectMany((_, peer) => Columns($"seen_{peer}")), .. run.Views.SelectMany(view => Columns($"predicted_{view.Peer}")),
                "seen_error_m", "settled_error_m",
            ]);
        for (int n = 0; n < trace.Seconds.Length; n++)
        {
            csv.WriteRow(
            [
                trace.Seconds[n], .. Cells(trace.Hand[n]), .. trace.Balls.SelectMany(ball => Cells(ball[n])), .. trace.Drawn.SelectMany(drawn => Cells(drawn[n])),
                trace.SeenError[n], trace.SettledError[n],
            ]);
        }

        static string[] Columns(string of) => [$"{of}_x_m", $"{of}_y_m", $"{of}_z_m"];

        static object?[] Cells(Vector3D at) => [at.X, at.Y, at.Z];
    }

    /// <summary>Writes a row for each horizon: the values of the JSON, and each candidate.</summary>
    private static void Errors(string path, IReadOnlyList<PredictionError> errors)
    {
        using StreamWriter file = new(path);
        CsvFile csv = new(
            file,
            [
                "horizon_ms", "adaptive_m", "best_in_hindsight_m", "linear_bound_m", "least_worst_m",
                .. AdaptivePredictor.Candidates.Select(name => $"{name.Replace(' ', '_')}_m"),
            ]);
        foreach (PredictionError error in errors)
        {
            csv.WriteRow(
            [
                error.HorizonMilliseconds, error.AdaptiveMetres, error.BestInHindsightMetres, error.LinearMetres, error.LowerBoundMetres,
                .. error.CandidateMetres.Select(metres => (object?)metres),
            ]);
        }
    }
}
