using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>A run as a chart, and a page that shows it.</summary>
internal static class RunReport
{
    private const int Samples = 2000;
    private const int MaxBodies = 7;

    internal static void Write(string folder, Scene scene, RunSummary run, ulong seed, string? sampleFile, SimDuration history, Action<SimDuration> progress)
    {
        HtmlReport report = new(
            $"LagSim run of {scene.Name}",
            string.Create(CultureInfo.InvariantCulture, $"{run.Until.ToSeconds():0.#########} s, {NumberText.Count(run.End.EventsProcessed, "event")},"
                + $" {NumberText.Count(run.End.ImpactsProcessed, "impact")}. Samples: {Path.GetFileName(sampleFile)}."),
            new ReportFooter("lagsim", ToolVersion.Text, seed, JsonDocumentWriter.Hash(scene.Hash)));
        if (scene.Bodies.Count > 0 && run.Until > SimTime.Zero)
        {
            LineChart chart = Heights(scene, run.Until - SimTime.Zero, history, progress);
            chart.Save(Path.Combine(folder, "heights.svg"));
            report.AddChart(chart);
        }

        report.Save(Path.Combine(folder, "report.html"));
    }

    private static LineChart Heights(Scene scene, SimDuration length, SimDuration history, Action<SimDuration> progress)
    {
        int bodies = Math.Min(scene.Bodies.Count, MaxBodies);
        List<double> seconds = [];
        List<double>[] heights = Enumerable.Range(0, bodies).Select(_ => new List<double>()).ToArray();
        new SceneRun(scene)
        {
            History = history,
            SampleEverySeconds = Math.Max(1e-9, length.ToSeconds() / Samples),
            OnSample = (time, simulation) =>
            {
                seconds.Add(time.ToSeconds());
                for (int body = 0; body < bodies; body++)
                {
                    simulation.TryRead(BodyId.OfScene(body), time, out BodyState state);
                    heights[body].Add(state.Position.Y);
                }
            },
        }.Run(length, progress);

        double[] x = seconds.ToArray();
        string shown = bodies < scene.Bodies.Count ? string.Create(CultureInfo.InvariantCulture, $" (the first {bodies} bodies)") : "";
        return new LineChart(
            $"Scene {scene.Name}",
            "Height of each body against time.",
            [new ChartPanel($"Height of the centres{shown}", "height (m)", heights.Select((h, n) => new ChartSeries(scene.Bodies[n].Name, x, h.ToArray(), SeriesStyle.Line, n)).ToArray()) { PlotHeight = 300 }]);
    }
}
