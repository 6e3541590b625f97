using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Charts;
using LagSim.Harness.Reports;
using LagSim.Harness.Runs;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>A run as a picture, and a page that shows it.</summary>
internal static class RunReport
{
    private const int Samples = 2000;
    private const int MostBodies = 7;

    internal static void Write(string folder, Scene scene, RunSummary run, ulong seed, string? sampleFile)
    {
        int bodies = System.Math.Min(scene.Bodies.Count, MostBodies);
        List<double> seconds = [];
        List<double>[] heights = Enumerable.Range(0, bodies).Select(_ => new List<double>()).ToArray();
        SimDuration length = run.Until - SimTime.Zero;
        if (bodies == 0 || length == SimDuration.Zero)
        {
            return;
        }

        new SceneRun(scene)
        {
            SampleEvery = SimDuration.FromTicks(System.Math.Max(1, length.Ticks / Samples)),
            OnSample = (time, simulation) =>
            {
                seconds.Add(time.ToSeconds());
                for (int body = 0; body < bodies; body++)
                {
                    simulation.TryRead(BodyId.OfScene(body), time, out BodyState state);
                    heights[body].Add(state.Position.Y);
                }
            },
        }.Run(length);

        double[] x = seconds.ToArray();
        string shown = bodies < scene.Bodies.Count ? string.Create(CultureInfo.InvariantCulture, $" (the first {bodies} bodies)") : "";
        LineChart chart = new(
            $"Scene {scene.Name}",
            "Height of each body against time.",
            [new ChartPanel($"Height of the centres{shown}", "height (m)", heights.Select((h, n) => new ChartSeries(scene.Bodies[n].Name, x, h.ToArray(), SeriesStyle.Line, n)).ToArray()) { PlotHeight = 300 }]);
        chart.Save(Path.Combine(folder, "heights.svg"));
        new HtmlReport(
            $"LagSim run of {scene.Name}",
            string.Create(CultureInfo.InvariantCulture, $"{run.Until.ToSeconds()} s, {run.End.EventsProcessed} events, {run.End.ImpactsProcessed} impacts. Samples: {Path.GetFileName(sampleFile)}."),
            new ReportFooter("lagsim", ToolVersion.Text, seed, JsonDocumentWriter.Hash(scene.Hash)))
            .AddChart(chart)
            .Save(Path.Combine(folder, "report.html"));
    }
}
