using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Sweep;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>A chart of the sweep over full links: what was delivered, the round trip and the refusals against the load offered.</summary>
internal static class SweepChart
{
    /// <summary>Draws the chart; null if no cell has any result.</summary>
    /// <param name="outcomes">The outcomes to show.</param>
    /// <param name="beside">The outcomes of another run, drawn dashed; null for none.</param>
    internal static LineChart? Of(IReadOnlyList<SweepOutcome> outcomes, IReadOnlyList<SweepOutcome>? beside)
    {
        SweepOutcome[] drawn = Drawn(outcomes), dashed = Drawn(beside ?? []);
        if (drawn.Length == 0)
        {
            return null;
        }

        return new LineChart(
            "Full links: delivered, round trip and refusals against offered load",
            "Each curve is one rate of the links; each point the mean of the cells of that rate and load, whatever their queues and dips." + (beside is null ? "" : " Dashed: before."),
            [
                new ChartPanel("delivered, of what was offered", "share", Curves(o => o.DeliveredBytesPerSecond / o.OfferedBytesPerSecond)) { HasLegendAtRight = true },
                new ChartPanel("round trip, median, of the idle one", "times the idle one", Curves(o => o.RoundTripP50Ms / o.IdleRoundTripMs)) { HasLegendAtRight = true, Scale = ChartScale.Log10 },
                new ChartPanel("refused, of what was done", "share", Curves(o => o.Done == 0 ? 0 : o.Refused / (double)o.Done)) { HasLegendAtRight = true },
                new ChartPanel("lost, of what clients were to hear of", "share", Curves(o => o.Done == 0 ? 0 : o.Lost / ((double)o.Done * o.Cell.Clients))) { HasLegendAtRight = true },
            ])
        {
            XLabel = "offered load, of what the link carries (in its dips)",
            XScale = ChartScale.Log10,
        };

        List<ChartSeries> Curves(Func<SweepOutcome, double> of) => [.. Series(drawn, of, "", SeriesStyle.Line), .. Series(dashed, of, ", before", SeriesStyle.Dashed)];
    }

    private static SweepOutcome[] Drawn(IReadOnlyList<SweepOutcome> outcomes) => [.. outcomes.Where(o => o.Cell.EventsPerSecond > 0 && o.OfferedBytesPerSecond > 0)];

    private static IEnumerable<ChartSeries> Series(SweepOutcome[] drawn, Func<SweepOutcome, double> of, string suffix, SeriesStyle style) =>
        drawn.GroupBy(o => o.Cell.RateBitsPerSecond).OrderBy(g => g.Key).Select((rate, n) =>
        {
            var points = rate.GroupBy(o => o.LoadShare).Select(g => (X: g.Key, Y: g.Average(of))).Where(p => double.IsFinite(p.Y)).OrderBy(p => p.X).ToArray();
            string name = FormattableString.Invariant($"{rate.Key / 1000.0} kbit/s{suffix}");
            return new ChartSeries(name, [.. points.Select(p => p.X)], [.. points.Select(p => p.Y)], style, n % LineChart.Colours);
        });
}
