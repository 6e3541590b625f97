using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Charts;
using LagSim.Harness.Hands;
using LagSim.Harness.Reports;
using LagSim.Net.Display;

namespace LagSim.Cli.Output;

/// <summary>The prediction of a hand as files: a CSV of the errors, a picture of them and of the motion, and a page that shows them.</summary>
internal static class HoldFiles
{
    internal static void Write(string folder, HandMotion motion, IReadOnlyList<PredictionError> errors, ulong seed)
    {
        Directory.CreateDirectory(folder);
        LineChart byDelay = HoldChart.OfErrors(motion, errors);
        LineChart path = HoldChart.OfMotion(motion);
        byDelay.Save(Path.Combine(folder, "hold-prediction.svg"));
        path.Save(Path.Combine(folder, "hold-motion.svg"));
        Errors(Path.Combine(folder, "hold-prediction.csv"), errors);
        new HtmlReport("LagSim: a hand told from the past", $"Motion {motion.Name}, {HandMotion.RateHertz} samples a second.", new ReportFooter("lagsim", ToolVersion.Text, seed, null))
            .AddChart(byDelay)
            .AddTable(new ReportTable("Rms error in mm, by the age of the newest sample in ms", HoldTables.Headings, errors.Select(HoldTables.Row).ToList()))
            .AddChart(path)
            .Save(Path.Combine(folder, "report.html"));
    }

    /// <summary>A row a horizon: what the JSON has, and each candidate.</summary>
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
                error.HorizonMilliseconds, error.AdaptiveMetres, error.BestInHindsightMetres, error.LinearMetres, error.LeastWorstMetres,
                .. error.CandidateMetres.Select(metres => (object?)metres),
            ]);
        }
    }
}
