using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>Speed against error as charts: error against CPU time, and error against step.</summary>
internal static class AccuracyChart
{
    /// <summary>Draws error against CPU time, a curve for each method; null if there is nothing to draw.</summary>
    internal static LineChart? OfWork(AccuracyReport report, WorkScene scene) => Of(
        scene, $"{scene.Name}: speed against error", "CPU time for all of it (s); left and below is better",
        method => [.. PointsOf(report, scene, method)], point => point.CpuSeconds, isJoined: (_, _) => true, note: (_, _) => "");

    /// <summary>Draws error against step, a curve for each method with its measured order; null if no method has steps.</summary>
    /// <remarks>Points that may be rounding are not joined, since they have no meaningful slope.</remarks>
    internal static LineChart? OfSteps(AccuracyReport report, WorkScene scene) => Of(
        scene, $"{scene.Name}: error against step", "step (s)",
        method => [.. PointsOf(report, scene, method).Where(point => point.StepSeconds > 0)], point => point.StepSeconds,
        isJoined: (a, b) => a.Error >= scene.Rounding && b.Error >= scene.Rounding,
        note: (method, points) => report.Work.Orders.FirstOrDefault(o => o.Scene == scene.Name && o.Method == method) is WorkOrder order
            ? FormattableString.Invariant($"order {order.Slope:0.00}, from {order.Points} points")
            : points.All(point => point.Error < scene.Rounding) ? "no order: rounding alone" : "no order: too few points");

    private static IEnumerable<WorkPoint> PointsOf(AccuracyReport report, WorkScene scene, string method) => report.Work.Points.Where(
        point => point.Scene == scene.Name && point.Method == method && point.ErrorKind == scene.ErrorKinds[0] && double.IsFinite(point.Error));

    private static LineChart? Of(
        WorkScene scene, string title, string xLabel, Func<string, WorkPoint[]> pointsOf, Func<WorkPoint, double> x,
            Func<WorkPoint, WorkPoint, bool> isJoined, Func<string, WorkPoint[], string> note)
    {
        List<ChartSeries> series = [];
        bool hasRounding = false;
        for (int n = 0; n < WorkMethods.All.Count; n++)
        {
            string name = WorkMethods.All[n].Name;
            WorkPoint[] points = pointsOf(name);
            if (points.Length > 0)
            {
                AccuracyStyle style = AccuracyStyle.Of(n);
                series.Add(Series(name, style, points, x, isJoined, note(name, points)));
                hasRounding |= points.Any(point => point.Error < scene.Rounding);
            }
        }

        WorkErrorWords words = WorkErrorKinds.Of(scene.ErrorKinds[0]);
        return series.Count == 0
            ? null
            : new LineChart(
                title,
                $"{scene.Title}. The {words.Sentence}; held against: {scene.Reference}. {WorkFindings.Caution}",
                [
                    new ChartPanel(scene.Title, words.Axis, series)
                    {
                        Scale = ChartScale.Log10,
                        PlotHeight = 400,
                        HasLegendAtRight = true,
                        Band = hasRounding ? new ShadedBand(scene.Rounding, $"may be rounding: below {NumberText.Short(scene.Rounding)}") : null,
                    },
                ])
            {
                XLabel = xLabel,
                XScale = ChartScale.Log10,
            };
    }

    /// <summary>Returns a curve through the points, with a break between two that are not joined.</summary>
    private static ChartSeries Series(
        string name, AccuracyStyle style, WorkPoint[] points, Func<WorkPoint, double> x, Func<WorkPoint, WorkPoint, bool> isJoined, string note)
    {
        List<double> xs = [], ys = [];
        for (int n = 0; n < points.Length; n++)
        {
            if (n > 0 && !isJoined(points[n - 1], points[n]))
            {
                xs.Add(x(points[n]));
                ys.Add(double.NaN);
            }

            xs.Add(x(points[n]));
            ys.Add(points[n].Error);
        }

        return new ChartSeries(name, [.. xs], [.. ys], style.IsOwn ? SeriesStyle.Line : SeriesStyle.Dashed, style.Colour)
        {
            Shape = style.Shape,
            IsEmphasised = style.IsOwn,
            Note = note,
        };
    }
}
