using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>The charts of a drop test: height against time, and the error below it.</summary>
internal static class DropChart
{
    private const double ErrorFloor = 1e-12;

    /// <summary>The lead before the lift in a chart, so that the marker is not on the frame.</summary>
    private const double LeadSeconds = 0.5;

    /// <summary>The least time before and after an event in its chart.</summary>
    private const double MinMarginSeconds = 0.02;

    private const string Time = "shared time since the start of the scene (s)";

    /// <param name="run">The run to show.</param>
    /// <param name="before">The case before it in the same run, whose end is shown too; null for none.</param>
    internal static LineChart Of(DropRun run, DropRun? before = null)
    {
        DropTrace trace = before is null ? run.Trace : WithLead(run.Trace, before.Trace);
        List<ChartMarker> markers = trace.Impacts.Select(at => new ChartMarker(at, "impact", MarkerKind.Tick)).ToList();
        List<ChartMarker> lift = Known(run);
        ChartSeries[] heights = trace.Heights
            .Select((h, peer) => new ChartSeries(Peer(peer), trace.Seconds, h, peer == 0 ? SeriesStyle.Line : SeriesStyle.Dashed, peer))
            .ToArray();
        ChartSeries[] errors =
        [
            new("as seen", trace.Seconds, trace.SeenError, SeriesStyle.Line, 2),
            new("as seen, at the same true time", trace.Seconds, trace.SeenTrueTimeError, SeriesStyle.Line, 3),
            new("as settled", trace.Seconds, trace.SettledError, SeriesStyle.Dashed, 4),
        ];
        return new LineChart(
            $"Drop test, {DropNames.Case(run.Case)}, {run.Options.Strategy}",
            "Height of the ball at each peer against shared time, and below it how far apart the peers were.",
            [
                new ChartPanel("Height of the ball's centre, as seen", "height (m)", heights) { Markers = [.. markers, .. lift], PlotHeight = 260 },
                new ChartPanel("Distance between the peers", "error (m)", errors)
                {
                    Scale = ChartScale.Log10, LogFloor = ErrorFloor, ReferenceLines = Thesis(run), Markers = lift,
                },
            ])
        {
            XLabel = Time,
        };
    }

    /// <summary>Draws the milliseconds around the lift: from just before it until just after the last peer received it.</summary>
    /// <param name="run">The run to show.</param>
    /// <param name="before">The case before it in the same run; null for none.</param>
    /// <returns>The chart; null for a case without a lift.</returns>
    internal static LineChart? OfEvent(DropRun run, DropRun? before = null)
    {
        if (run.Trace is not { Lift: double lifted, Dealt: double dealt })
        {
            return null;
        }

        double margin = Math.Max(MinMarginSeconds, dealt - lifted);
        DropTrace trace = before is null ? run.Trace : WithLead(run.Trace, before.Trace);
        int from = Math.Max(0, Array.FindIndex(trace.Seconds, seconds => seconds >= lifted - margin));
        int end = Array.FindLastIndex(trace.Seconds, seconds => seconds <= dealt + margin) + 1;
        double[] seconds = trace.Seconds[from..end];
        ChartSeries[] heights = trace.Heights
            .Select((h, peer) => new ChartSeries(Peer(peer), seconds, h[from..end], peer == 0 ? SeriesStyle.Line : SeriesStyle.Dashed, peer)
            {
                Shape = peer == 0 ? PointShape.Disc : PointShape.Circle,
            })
            .ToArray();
        return new LineChart(
            $"From the lift until all know of it: {NumberText.Short((dealt - lifted) * 1000)} ms",
            "Height of the ball at each peer, sample by sample, around the moment at which one side lifts it.",
            [new ChartPanel("Height of the ball's centre, as seen", "height (m)", heights) { Markers = Known(run), PlotHeight = 160 }])
        {
            XLabel = Time,
        };
    }

    /// <summary>
    /// Draws a panel for each strategy, all on one scale. Strategies that agree have the same curve, and in one panel only the last drawn
    /// would be visible.
    /// </summary>
    /// <param name="runs">A run for each strategy.</param>
    /// <param name="shown">The runs of the charts above. All times here are shifted to their lift.</param>
    internal static LineChart OfStrategies(IReadOnlyList<DropRun> runs, IReadOnlyList<DropRun> shown)
    {
        double? lift = shown.Select(run => run.Trace.Lift).FirstOrDefault(at => at is not null);
        runs = [.. runs.Select(run => run with { Trace = Moved(run.Trace, lift - run.Trace.Lift ?? 0) })];
        double most = runs.SelectMany(run => run.Trace.SeenError).Where(error => !double.IsNaN(error)).DefaultIfEmpty().Max();
        return new LineChart(
            "Drop test, teleport: every strategy",
            "How far apart the peers were, as seen, with each strategy for late events.",
            runs.Select((run, n) => new ChartPanel(
                run.Options.Strategy, "error (m)", [new ChartSeries("between the peers, as seen", run.Trace.Seconds, run.Trace.SeenError, SeriesStyle.Line, n)])
            {
                Scale = ChartScale.Log10,
                LogFloor = ErrorFloor,
                PlotHeight = 96,
                Reaches = [ErrorFloor, most],
                ReferenceLines = Thesis(run),
                Markers = Known(run),
            }).ToArray())
        {
            XLabel = Time + (lift is null ? "" : "; the ball is lifted when it is above"),
        };
    }

    private static string Peer(int peer) => peer == 0 ? "host" : $"client {peer}";

    /// <summary>Returns the same run shifted to later times.</summary>
    private static DropTrace Moved(DropTrace trace, double later) => later == 0 ? trace : trace with
    {
        Seconds = Array.ConvertAll(trace.Seconds, at => at + later),
        Impacts = Array.ConvertAll(trace.Impacts, at => at + later),
        Lift = trace.Lift + later,
        Dealt = trace.Dealt + later,
    };

    private static DropTrace WithLead(DropTrace trace, DropTrace before)
    {
        int from = Array.FindIndex(before.Seconds, seconds => seconds >= trace.Seconds[0] - LeadSeconds);
        return from < 0 ? trace : trace with
        {
            Seconds = Joined(before.Seconds, trace.Seconds),
            Heights = [.. trace.Heights.Select((heights, peer) => Joined(before.Heights[peer], heights))],
            SeenError = Joined(before.SeenError, trace.SeenError),
            SeenTrueTimeError = Joined(before.SeenTrueTimeError, trace.SeenTrueTimeError),
            SettledError = Joined(before.SettledError, trace.SettledError),
        };

        double[] Joined(double[] earlier, double[] own) => [.. earlier[from..], .. own];
    }

    /// <summary>Returns markers of the lift, and of when the last peer showed it; none without a lift.</summary>
    private static List<ChartMarker> Known(DropRun run) => run.Trace.Lift is double lifted && run.Trace.Dealt is double dealt
        ? [new ChartMarker(lifted, "lifted here"), new ChartMarker(dealt, "known to all")]
        : [];

    /// <summary>Returns the thesis's figure, where it is comparable.</summary>
    private static ReferenceLine[] Thesis(DropRun run) =>
        run.Case == DropCase.Teleport && run.Options.IsThesisSetting ? [new ReferenceLine(ThesisFigures.TeleportRms, "thesis, rms 0.029 m")] : [];
}
