using System.IO;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>
/// Speed against error as files: a CSV with a row for each point and kind of error, two charts for each scene, and a page that shows them.
/// </summary>
internal static class AccuracyFiles
{
    internal static void Write(string folder, AccuracyReport report)
    {
        Directory.CreateDirectory(folder);
        using (StreamWriter file = new(Path.Combine(folder, "accuracy.csv")))
        {
            CsvFile csv = new(file, "scene", "method", "setting", "error", "error_kind", "cpu_s", "simulated_s", "events");
            foreach (WorkPoint point in report.Work.Points)
            {
                csv.WriteRow(point.Scene, point.Method, point.Setting, point.Error, point.ErrorKind, point.CpuSeconds, point.SimulatedSeconds, point.Events);
            }
        }

        HtmlReport page = new(
            "LagSim: speed against error",
            "Each claim of speed beside its error: every scene by every method, its step swept. " + WorkFindings.Caution,
            new ReportFooter("lagsim", ToolVersion.Text, report.Seed, null));
        foreach (WorkScene scene in report.Scenes)
        {
            page.AddHeading($"{scene.Name}: {scene.Title}");
            Chart(AccuracyChart.OfWork(report, scene), $"accuracy-{scene.Name}-work.svg");
            Chart(AccuracyChart.OfSteps(report, scene), $"accuracy-{scene.Name}-steps.svg");
            page.AddTable(new ReportTable(AccuracyTables.Title(scene), AccuracyTables.Headings(scene), [.. AccuracyTables.Rows(report, scene)]));
        }

        if (report.Spread.Count > 0)
        {
            page.AddTable(new ReportTable(
                AccuracyTables.SpreadTitle, AccuracyTables.SpreadHeadings, [.. AccuracyTables.SpreadRows(report)]));
        }

        page.AddHeading("What this says, and what is left out");
        foreach (string line in AccuracyTables.Footnotes(report))
        {
            page.AddParagraph(line);
        }

        page.Save(Path.Combine(folder, "report.html"));

        void Chart(LineChart? chart, string name)
        {
            if (chart is not null)
            {
                chart.Save(Path.Combine(folder, name));
                page.AddChart(chart, WorkFindings.Caution);
            }
        }
    }
}
