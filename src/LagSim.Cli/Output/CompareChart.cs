using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>
/// The charts of a comparison: a panel for each strategy, all on one scale, since strategies that agree have the same curve.
/// </summary>
internal static class CompareChart
{
    private const double ErrorFloor = 1e-9;
    private const double LargestFloor = 1e-3; // the largest errors of a run lie in a decade or two: smaller ones look like agreement
    private const double LatenessFloor = 0.01;
    private const double PanelHeight = 96;

    /// <summary>Draws one link: the distance between peers over time.</summary>
    internal static LineChart OfLink(IReadOnlyList<CompareRun> runs)
    {
        double[] all = runs.SelectMany(run => new[] { Largest(run.Trace.SeenError), Largest(run.Trace.SeenFromTruth) }).ToArray();
        return new LineChart(
            $"{runs[0].Options.Scene.Name} on {runs[0].Options.Link.Name}: every strategy",
            "For each strategy the largest distance of a body between the host's view and another peer's,"
                + " and from a world that had every event on time."
                + " Triangles are events.",
            runs.Select(run => new ChartPanel(
                run.Options.Strategy,
                "error (m)",
                [
                    new ChartSeries("between the peers, as seen", run.Trace.Seconds, run.Trace.SeenError, SeriesStyle.Line, 0),
                    new ChartSeries("from the world that had all on time", run.Trace.Seconds, run.Trace.SeenFromTruth, SeriesStyle.Dashed, 1),
                ])
            {
                Scale = ChartScale.Log10,
                LogFloor = ErrorFloor,
                Reaches = [ErrorFloor, .. all],
                PlotHeight = PanelHeight,
                Markers = run.Trace.Events.Select(e => new ChartMarker(e.Stamp, "event", MarkerKind.Tick)).ToArray(),
            }).ToArray())
        {
            XLabel = "shared time since the start of the scene (s)",
        };
    }

    /// <summary>Draws all links, by the lateness of their latest event.</summary>
    internal static LineChart OfLinks(IReadOnlyList<CompareRun> runs)
    {
        string[] strategies = runs.Select(run => run.Options.Strategy).Distinct().ToArray();
        double[] all = runs.SelectMany(run => new[] { During(run), After(run), run.Corrections.Max }).ToArray();
        return new LineChart(
            $"{runs[0].Options.Scene.Name}: every strategy on every link",
            "For each strategy the largest error as seen while events are on their way and after, and the furthest jump, for each link, by how late its"
                + " latest event came.",
            strategies.Select(strategy =>
            {
                CompareRun[] own = runs.Where(run => run.Options.Strategy == strategy).OrderBy(run => run.Lateness.Max).ToArray();
                double[] late = Array.ConvertAll(own, run => Math.Max(run.Lateness.Max, LatenessFloor));
                return new ChartPanel(
                    strategy,
                    "metres",
                    [
                        new ChartSeries("during", late, Array.ConvertAll(own, During), SeriesStyle.Line, 0),
                        new ChartSeries("after", late, Array.ConvertAll(own, After), SeriesStyle.Points, 1),
                        new ChartSeries("furthest jump", late, Array.ConvertAll(own, run => run.Corrections.Max), SeriesStyle.Dashed, 2),
                    ])
                {
                    Scale = ChartScale.Log10,
                    LogFloor = LargestFloor,
                    Reaches = [LargestFloor, Math.Max(LargestFloor, Largest(all))],
                    PlotHeight = PanelHeight,
                };
            }).ToArray())
        {
            XLabel = "the latest event on a link (ms; what is less than 0.01 at 0.01)",
            XScale = ChartScale.Log10,
        };
    }

    private static double During(CompareRun run) => run.Seen.During.ToStatistics().MaxMetres;

    private static double After(CompareRun run) => run.Seen.After.ToStatistics().MaxMetres;

    private static double Largest(double[] errors) => errors.Where(error => !double.IsNaN(error)).DefaultIfEmpty().Max();
}
