using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Reports.Charts;
using LagSim.Scenes;

namespace LagSim.Cli.Output;

/// <summary>
/// The charts of a hand: the held ball and the throw as another peer saw them, the errors by delay, the prediction errors, and the motion.
/// </summary>
internal static class HoldChart
{
    private const double ErrorFloor = 1e-4;
    private const double WindowSeconds = 6;
    private const double SmallPanel = 110;
    private const string TimeLabel = "shared time since the start of the scene (s)";
    private const int Hand = 6, Simulated = 0, Predicted = 1, Own = 2, Best = 3, Last = 4;

    /// <summary>
    /// Draws some seconds from the middle of every hold, a panel for each link: the hand, and the ball as another peer saw it (Fig 4, 5).
    /// </summary>
    internal static LineChart OfViews(HandMotion motion, IReadOnlyList<HoldRun> runs)
    {
        Func<Vector3D, double> axis = Axis(runs[0], out string name);
        ChartSeries[][] lines = runs.Select(run => Lines(run, axis)).ToArray();
        double[] all = lines.SelectMany(of => of).SelectMany(series => series.Y).Where(double.IsFinite).ToArray();
        return new LineChart(
            $"The held ball as {Viewer(runs[0])} saw it: {motion.Name} motion",
            "For each link one coordinate of the hand against shared time, and of the ball that it holds as another peer saw it, as its world has it and as"
                + " the predictor draws it.",
            runs.Select((run, n) => new ChartPanel(run.Options.Link.Name, $"{name} (m)", lines[n]) { PlotHeight = SmallPanel, Reaches = [all.Min(), all.Max()] }).ToArray())
        {
            XLabel = TimeLabel,
        };
    }

    /// <summary>Draws one link at a larger size, with the error of the ball below it.</summary>
    internal static LineChart OfHold(HandMotion motion, HoldRun run)
    {
        HoldTrace trace = run.Trace;
        int[] shown = Middle(run);
        ChartSeries Off(string name, Vector3D[] ball, SeriesStyle style, int colour) => Series(run, name, shown, n => (ball[n] - trace.Hand[n]).Length, style, colour);
        return new LineChart(
            $"In the hand, {run.Options.Link.Name}: {motion.Name} motion",
            "Above one coordinate of the hand against shared time, and of the ball as another peer saw it; below how far the ball was from the hand, for its"
                + " holder too.",
            [
                new ChartPanel($"The hand, and the ball as {Viewer(run)} saw it", $"{Coordinate(run)} (m)", Lines(run, Axis(run, out _))) { PlotHeight = 260 },
                new ChartPanel(
                    "Distance from the hand",
                    "error (m)",
                    [
                        Off("as simulated", trace.Balls[run.Views[0].Peer], SeriesStyle.Line, Simulated),
                        Off("as predicted", trace.Drawn[0], SeriesStyle.Line, Predicted),
                        Off("as its holder saw it", trace.Balls[HoldTest.Holder], SeriesStyle.Line, Own),
                    ]),
            ])
        {
            XLabel = TimeLabel,
        };
    }

    /// <summary>Draws the throw on one link, as every peer saw it.</summary>
    internal static LineChart OfThrow(HandMotion motion, HoldRun run)
    {
        HoldTrace trace = run.Trace;
        int[] shown = Shown(run, trace.Release - 0.5, trace.Release + 2.5);
        bool isKnown = trace.Known is double known && known <= trace.Seconds[shown[^1]];
        ChartMarker[] markers = [new(trace.Release, "thrown here"), .. isKnown ? new[] { new ChartMarker((double)trace.Known!, "known to all") } : []];
        return new LineChart(
            $"The throw, {run.Options.Link.Name}: {motion.Name} motion",
            "Height of the ball at each peer against shared time, and below it how far apart the peers were.",
            [
                new ChartPanel(
                    "Height of the ball's centre, as seen",
                    "height (m)",
                    trace.Balls.Select((ball, peer) => Series(
                        run, HoldTables.PeerName(peer), shown, n => ball[n].Y, peer == HoldTest.Holder ? SeriesStyle.Dashed : SeriesStyle.Line, peer)).ToArray())
                {
                    Markers = markers, PlotHeight = 260,
                },
                new ChartPanel(
                    "Distance between the peers",
                    "error (m)",
                    [
                        Series(run, "as seen", shown, n => trace.SeenError[n], SeriesStyle.Line, 2),
                        Series(run, "as settled", shown, n => trace.SettledError[n], SeriesStyle.Dashed, 4),
                    ])
                {
                    Scale = ChartScale.Log10, LogFloor = ErrorFloor, Markers = markers,
                },
            ])
        {
            XLabel = TimeLabel,
        };
    }

    /// <summary>The charts over delay: the errors of the held ball, and the bandwidth of its keyframes.</summary>
    internal static LineChart OfDelays(HoldReport report)
    {
        HoldRun[] runs = report.Runs.Where(run => run.Options.DelayMilliseconds is not null).OrderBy(run => run.Options.DelayMilliseconds).ToArray();
        double[] delays = Array.ConvertAll(runs, run => run.Options.DelayMilliseconds!.Value);
        double[] horizons = report.Predictions.Select(error => error.HorizonMilliseconds).Where(ms => ms <= delays[^1]).ToArray();
        ChartSeries Line(string name, Func<HoldRun, double> of, int colour, SeriesStyle style = SeriesStyle.Line) =>
            new(name, delays, Array.ConvertAll(runs, run => of(run)), style, colour);
        ChartSeries[] errors =
        [
            Line("as simulated", run => run.Views[0].Simulated.RmsMetres, Simulated),
            Line("predicted", run => run.Views[0].Predicted.RmsMetres, Predicted),
            Line("best in hindsight", run => run.Views[0].BestInHindsightMetres, Best, SeriesStyle.Dashed),
            Line("hold last", run => run.Views[0].HoldLastMetres, Last, SeriesStyle.Dashed),
            Line("holder's own", run => run.Own.RmsMetres, Own),
            new("adaptive, from all samples", horizons, report.Predictions.Take(horizons.Length).Select(error => error.AdaptiveMetres).ToArray(), SeriesStyle.Dashed, Hand),
        ];
        return new LineChart(
            $"The held ball by delay: {report.Motion.Name} motion",
            "Rms distance of the held ball from the hand, as another peer saw it, against the delay; below it what the holder sends and receives.",
            [
                new ChartPanel("Rms error", "error (m)", errors) { PlotHeight = 260 },
                new ChartPanel(
                    "Traffic of the holder", "bytes a second",
                    [Line("sent", run => run.HolderSentPerSecond, Simulated), Line("received", run => run.HolderReceivedPerSecond, Predicted)]) { Reaches = [0] },
            ])
        {
            XLabel = "delay one way (ms)",
        };
    }

    internal static LineChart OfErrors(HandMotion motion, IReadOnlyList<PredictionError> errors)
    {
        double[] delays = errors.Select(error => error.HorizonMilliseconds).ToArray();
        ChartSeries Series(string name, Func<PredictionError, double> of, SeriesStyle style, int colour) => new(name, delays, errors.Select(of).ToArray(), style, colour);
        ChartSeries[] series =
        [
            Series("hold last", error => error.HoldLastMetres, SeriesStyle.Line, 1),
            Series("velocity", error => error.VelocityMetres, SeriesStyle.Line, 2),
            Series("adaptive", error => error.AdaptiveMetres, SeriesStyle.Line, 0),
            Series("best in hindsight", error => error.BestInHindsightMetres, SeriesStyle.Dashed, 3),
            Series("linear, 20 taps, fitted to the motion", error => error.LinearMetres, SeriesStyle.Dashed, 4),
        ];
        return new LineChart(
            $"A hand told from the past: {motion.Name} motion",
            "Rms error of each way to predict a hand against the age of the newest sample.",
            [
                new ChartPanel("Rms error", "error (m)", series) { PlotHeight = 260 },
                new ChartPanel("The same, logarithmic", "error (m)", series) { Scale = ChartScale.Log10, LogFloor = ErrorFloor },
            ])
        {
            XLabel = "age of the newest sample (ms)",
        };
    }

    internal static LineChart OfMotion(HandMotion motion)
    {
        int[] samples = Enumerable.Range(0, motion.Count).ToArray();
        double[] seconds = samples.Select(n => n / (double)HandMotion.RateHertz).ToArray();
        ChartSeries Axis(string name, Func<Vector3D, double> of) => new(name, seconds, samples.Select(n => of(motion.PositionAt(n))).ToArray());
        return new LineChart(
            $"The hand: {motion.Name} motion",
            "Where the hand was against time.",
            [new ChartPanel("Position of the hand", "position (m)", [Axis("x", at => at.X), Axis("y", at => at.Y), Axis("z", at => at.Z)])]);
    }

    /// <summary>Returns the hand, and the ball as the first other peer saw it.</summary>
    private static ChartSeries[] Lines(HoldRun run, Func<Vector3D, double> axis)
    {
        HoldTrace trace = run.Trace;
        int[] shown = Middle(run);
        return
        [
            Series(run, "hand", shown, n => axis(trace.Hand[n]), SeriesStyle.Line, Hand),
            Series(run, "ball as simulated", shown, n => axis(trace.Balls[run.Views[0].Peer][n]), SeriesStyle.Line, Simulated),
            Series(run, "as predicted", shown, n => axis(trace.Drawn[0][n]), SeriesStyle.Line, Predicted),
        ];
    }

    private static ChartSeries Series(HoldRun run, string name, int[] shown, Func<int, double> of, SeriesStyle style, int colour) =>
        new(name, Array.ConvertAll(shown, n => run.Trace.Seconds[n]), Array.ConvertAll(shown, n => of(n)), style, colour);

    /// <summary>Returns the samples of some seconds from the middle of the hold, or of all of it.</summary>
    private static int[] Middle(HoldRun run)
    {
        double middle = (run.Trace.MotionStart + run.Trace.ThrowStart) / 2;
        return Shown(run, Math.Max(run.Trace.MotionStart, middle - (WindowSeconds / 2)), Math.Min(run.Trace.ThrowStart, middle + (WindowSeconds / 2)));
    }

    private static int[] Shown(HoldRun run, double from, double to) =>
        Enumerable.Range(0, run.Trace.Seconds.Length).Where(n => run.Trace.Seconds[n] >= from && run.Trace.Seconds[n] <= to).ToArray();

    /// <summary>Returns the coordinate in which the hand moves furthest there.</summary>
    private static Func<Vector3D, double> Axis(HoldRun run, out string name)
    {
        int[] shown = Middle(run);
        ((string Name, Func<Vector3D, double> Of) axis, double _) = new (string, Func<Vector3D, double>)[] { ("x", at => at.X), ("y", at => at.Y), ("z", at => at.Z) }
            .Select(one => (one, shown.Max(n => one.Item2(run.Trace.Hand[n])) - shown.Min(n => one.Item2(run.Trace.Hand[n])))).MaxBy(one => one.Item2);
        name = axis.Name;
        return axis.Of;
    }

    private static string Coordinate(HoldRun run)
    {
        Axis(run, out string name);
        return name;
    }

    private static string Viewer(HoldRun run) => run.Views[0].Peer == 0 ? "the host" : HoldTables.PeerName(run.Views[0].Peer);
}
