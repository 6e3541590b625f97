using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Sweep;

namespace LagSim.Cli.Output;

/// <summary>All cells of the sweep over full links as a Markdown table, beside another run if there is one.</summary>
internal static class SweepMarkdown
{
    internal static void Write(TextWriter output, IReadOnlyList<SweepOutcome> outcomes, IReadOnlyList<SweepOutcome>? beside)
    {
        Dictionary<SweepCell, SweepOutcome> others = (beside ?? []).ToDictionary(o => o.Cell);
        output.Write("| clients | kbit/s | queue, ms | dips | events/s | load | offered, B/s | delivered, B/s | sent, B/s | p50 / p99, ms | refused, % | lost | differ | copies | too slow |");
        output.WriteLine(beside is null ? "" : " before: delivered | sent | p50 / p99, ms | refused, % | lost | differ |");
        output.WriteLine(string.Concat(Enumerable.Repeat("|---", beside is null ? 15 : 21)) + "|");
        foreach (SweepOutcome o in outcomes)
        {
            string[] cells =
            [
                Text(o.Cell.Clients), Text(o.Cell.RateBitsPerSecond / 1000.0), Text(o.Cell.QueueMilliseconds), o.Cell.HasDips ? "yes" : "", Text(o.Cell.EventsPerSecond),
                Percent(o.LoadShare), Text(o.OfferedBytesPerSecond), Text(o.DeliveredBytesPerSecond), Text(o.SentBytesPerSecond), Trips(o), Refused(o), Text(o.Lost),
                Text(o.Differed), Text(o.Copies), Text(o.TooSlow),
            ];
            output.Write($"| {string.Join(" | ", cells)} |");
            if (beside is null)
            {
                output.WriteLine();
                continue;
            }

            string[] before = others.TryGetValue(o.Cell, out SweepOutcome? b)
                ? [Text(b.DeliveredBytesPerSecond), Text(b.SentBytesPerSecond), Trips(b), Refused(b), Text(b.Lost), Text(b.Differed)]
                : ["", "", "", "", "", ""];
            output.WriteLine($" {string.Join(" | ", before)} |");
        }
    }

    private static string Trips(SweepOutcome o) => $"{Text(o.RoundTripP50Ms)} / {Text(o.RoundTripP99Ms)}";

    private static string Refused(SweepOutcome o) => o.Done == 0 ? "" : Text(100.0 * o.Refused / o.Done);

    private static string Percent(double share) => string.Create(CultureInfo.InvariantCulture, $"{100 * share:0} %");

    private static string Text(double value) => value.ToString(Math.Abs(value) < 10 ? "0.#" : "#,0", CultureInfo.InvariantCulture);
}
