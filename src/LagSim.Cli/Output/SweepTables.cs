using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Sweep;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The sweep over full links as a table.</summary>
internal static class SweepTables
{
    /// <summary>What the columns are called.</summary>
    internal static readonly string[] Headings =
    [
        "clients", "kbit/s", "queue ms", "dips", "events/s each", "load", "offered B/s", "delivered B/s", "sent B/s", "idle ms", "p50 ms", "p99 ms", "refused", "lost", "differ",
        "compared", "copies", "too slow",
    ];

    internal static void Write(ToolConsole console, IReadOnlyList<SweepOutcome> outcomes, string? folder)
    {
        Table table = new();
        foreach (string heading in Headings)
        {
            table.AddColumn(new TableColumn(Markup.Escape(heading)).RightAligned());
        }

        foreach (SweepOutcome outcome in outcomes)
        {
            table.AddRow(Cells(outcome).Select(cell => new Text(cell)).ToArray());
        }

        console.Write(table);
        foreach (string line in Footnotes(outcomes))
        {
            console.Output.WriteLine(line);
        }

        if (folder is not null)
        {
            console.Output.WriteLine($"A page with charts: {System.IO.Path.Combine(folder, "report.html")}");
        }
    }

    internal static string[] Cells(SweepOutcome o) =>
    [
        Text(o.Cell.Clients), Text(o.Cell.RateBitsPerSecond / 1000.0), Text(o.Cell.QueueMilliseconds), o.Cell.HasDips ? "yes" : "", Text(o.Cell.EventsPerSecond),
        string.Create(CultureInfo.InvariantCulture, $"{100 * o.LoadShare:0} %"), Text(o.OfferedBytesPerSecond), Text(o.DeliveredBytesPerSecond), Text(o.SentBytesPerSecond),
        Text(o.IdleRoundTripMs), Text(o.RoundTripP50Ms), Text(o.RoundTripP99Ms), Text(o.Refused), Text(o.Lost), Text(o.Differed),
        string.Create(CultureInfo.InvariantCulture, $"{100 * o.ComparedShare:0} %"), Text(o.Copies), Text(o.TooSlow),
    ];

    internal static IEnumerable<string> Footnotes(IReadOnlyList<SweepOutcome> outcomes)
    {
        yield return $"Offered and delivered: what a client is to hear of, in bytes of entries. Sent: what the host sent it, datagrams with UDP and IP. Load: what the events need at"
            + " least, of what the link carries in its dips. Round trips are the client's, as it measures them; idle is before the first event.";
        SweepOutcome[] bad = [.. outcomes.Where(o => !o.IsGood)];
        yield return bad.Length == 0
            ? $"All {outcomes.Count} cells: no accepted event lost, no state that differs, at least 90 % of them compared."
            : $"{bad.Length} of {outcomes.Count} cells do not show what they must:";
        foreach (SweepOutcome o in bad)
        {
            yield return string.Create(
                CultureInfo.InvariantCulture,
                $"  {o.Cell}: {o.Failure ?? $"{o.Lost} lost, {o.Differed} differ, {100 * o.ComparedShare:0} % compared, {o.TooSlow} of the links too slow at {100 * o.LoadShare:0} % load"}");
        }
    }

    private static string Text(double value) => value.ToString(Math.Abs(value) < 10 ? "0.#" : "0", CultureInfo.InvariantCulture);
}
