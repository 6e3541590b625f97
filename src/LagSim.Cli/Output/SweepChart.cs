using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Charts;
using LagSim.Harness.Sweep;

namespace LagSim.Cli.Output;

/// <summary>The sweep over full links as a chart: what was delivered, the round trip and the refusals against what was offered.</summary>
internal static class SweepChart
{
    /// <summary>Null where there is nothing to draw: no cell in which anything happened.</summary>
    internal static LineChart? Of(IReadOnlyList<SweepOutcome> outcomes)
    {
        SweepOutcome[] drawn = [.. outcomes.Where(o => o.Cell.EventsPerSecond > 0 && o.OfferedBytesPerSecond > 0)];
        if (drawn.Length == 0)
        {
            return null;
        }

        return new LineChart(
            "Full links: delivered, round trip and refusals against offered load",
            "Each curve is one rate of the links; each point the mean of the cells of that rate and load, whatever their queues and dips.",
            [
                new ChartPanel("delivered, of what was offered", "share", Curves(o => o.DeliveredBytesPerSecond / o.OfferedBytesPerSecond)) { HasLegendAtRight = true },
                new ChartPanel("round trip, median, of the idle one", "times the idle one", Curves(o => o.RoundTripP50Ms / o.IdleRoundTripMs)) { HasLegendAtRight = true, Scale = ChartScale.Log10 },
                new ChartPanel("refused, of what was done", "share", Curves(o => o.Done == 0 ? 0 : o.Refused / (double)o.Done)) { HasLegendAtRight = true },
            ])
        {
            XLabel = "offered load, of what the link carries (in its dips)",
            XScale = ChartScale.Log10,
        };

        List<ChartSeries> Curves(Func<SweepOutcome, double> of) => [.. drawn.GroupBy(o => o.Cell.RateBitsPerSecond).OrderBy(g => g.Key).Select((rate, n) =>
        {
            var points = rate.GroupBy(o => o.LoadShare).Select(g => (X: g.Key, Y: g.Average(of))).Where(p => double.IsFinite(p.Y)).OrderBy(p => p.X).ToArray();
            return new ChartSeries(FormattableString.Invariant($"{rate.Key / 1000.0} kbit/s"), [.. points.Select(p => p.X)], [.. points.Select(p => p.Y)], SeriesStyle.Line, n % LineChart.Colours);
        })];
    }
}
