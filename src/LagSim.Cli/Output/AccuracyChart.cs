using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Accuracy;
using LagSim.Harness.Charts;

namespace LagSim.Cli.Output;

/// <summary>Speed against error as charts: error against CPU time, and error against step.</summary>
internal static class AccuracyChart
{
    /// <summary>Error against CPU time, a curve a method; null where there is nothing to draw.</summary>
    internal static LineChart? OfWork(AccuracyReport report, WorkScene scene) => Of(
        report, scene, isStep: false, $"{scene.Name}: speed against error", "CPU time for all of it (s); left and below is better", method => method);

    /// <summary>Error against step, a curve a method with its measured order; null where no method has steps.</summary>
    internal static LineChart? OfSteps(AccuracyReport report, WorkScene scene) => Of(
        report, scene, isStep: true, $"{scene.Name}: error against step", "step (s)",
        method => report.Work.Orders.FirstOrDefault(o => o.Scene == scene.Name && o.Method == method) is WorkOrder order
            ? $"{method}, order {order.Slope:0.00}" : method);

    /// <summary>An error's kind in words: <c>max_energy_relative</c> is largest energy (relative).</summary>
    private static string Label(string kind)
    {
        string words = kind.Replace("max_", "largest ", StringComparison.Ordinal).Replace('_', ' ');
        return words.EndsWith(" m", StringComparison.Ordinal) ? words[..^2] + " (m)"
            : words.EndsWith(" relative", StringComparison.Ordinal) ? words[..^" relative".Length] + " error (relative)"
            : words;
    }

    private static LineChart? Of(AccuracyReport report, WorkScene scene, bool isStep, string title, string xLabel, Func<string, string> legend)
    {
        IReadOnlyList<IWorkMethod> all = WorkMethods.All;
        List<ChartSeries> series = [];
        for (int slot = 0; slot < all.Count; slot++)
        {
            string name = all[slot].Name;
            WorkPoint[] points =
            [
                .. report.Work.Points.Where(p => p.Scene == scene.Name && p.Method == name && p.ErrorKind == scene.ErrorKinds[0] && double.IsFinite(p.Error)
                    && (!isStep || p.StepSeconds > 0)),
            ];
            if (points.Length > 0)
            {
                double[] x = [.. points.Select(p => isStep ? p.StepSeconds : p.CpuSeconds)], y = [.. points.Select(p => p.Error)];
                // LagSim's own Runge-Kutta is the same method as MathNet's: curves coincide; and a colour that comes again tells no two apart
                bool isDashed = all[slot].Engine == "mathnet" || slot >= LineChart.Colours;
                series.Add(new ChartSeries(legend(name), x, y, isDashed ? SeriesStyle.Dashed : SeriesStyle.Line, slot) { HasDots = true });
            }
        }

        return series.Count == 0
            ? null
            : new LineChart(
                title,
                $"{scene.Title}. {scene.ErrorKinds[0]} against {scene.Reference}. {WorkFindings.Caution}",
                [new ChartPanel(scene.Title, Label(scene.ErrorKinds[0]), series) { Scale = ChartScale.Log10, PlotHeight = 380 }])
            {
                XLabel = xLabel,
                XScale = ChartScale.Log10,
            };
    }
}
