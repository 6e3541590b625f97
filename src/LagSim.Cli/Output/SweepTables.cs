using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Sweep;
using LagSim.Harness.Reports;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The sweep over full links as a table.</summary>
internal static class SweepTables
{
    /// <summary>The names of the columns.</summary>
    internal static readonly string[] Headings =
    [
        "clients", "kbit/s", "queue ms", "dips", "events/s each", "load", "offered B/s", "delivered B/s", "sent B/s", "idle ms", "p50 ms", "p99 ms", "refused", "lost", "differ",
        "compared", "copies", "too slow",
    ];

    /// <summary>The number of leading columns that identify the cell of a row.</summary>
    private const int CellColumns = 5;

    /// <summary>The blanks between two columns, and at both edges.</summary>
    private const int Gap = 2;

    internal static void Write(ToolConsole console, IReadOnlyList<SweepOutcome> outcomes, string? folder, int count)
    {
        string[][] rows = [.. outcomes.Select(Cells)];
        foreach (int[] columns in Parts(console, rows))
        {
            console.Write(TableOf(columns, rows));
        }

        foreach (string line in Footnotes(outcomes))
        {
            console.Output.WriteLine(line);
        }

        if (outcomes.Count < count)
        {
            console.Output.WriteLine(FormattableString.Invariant($"stopped early: {outcomes.Count} of {count} cells played"));
        }

        if (folder is not null)
        {
            console.Output.WriteLine($"A page with charts: {System.IO.Path.Combine(folder, "report.html")}");
        }
    }

    /// <summary>
    /// Splits the columns into tables. If they do not fit the window together, there are several tables one below the other, each beginning
    /// with the columns that identify the cell, so that no heading is cut. On a terminal of less than 80 columns the rows are lists anyway.
    /// </summary>
    private static List<int[]> Parts(ToolConsole console, string[][] rows)
    {
        int[] all = [.. Enumerable.Range(0, Headings.Length)];
        if (!console.IsEndless && !console.IsWindow)
        {
            return [all];
        }

        List<int[]> parts = [];
        int[] part = all[..CellColumns];
        foreach (int column in all[CellColumns..])
        {
            int[] more = [.. part, column];
            if (more.Sum(n => WidthOf(n, rows) + Gap) + Gap > console.Rich.Profile.Width && part.Length > CellColumns)
            {
                parts.Add(part);
                more = [.. all[..CellColumns], column];
            }

            part = more;
        }

        return [.. parts, part];
    }

    /// <summary>
    /// Returns the larger of the longest word of the heading, which is wrapped at blanks, and the longest cell, which is not.
    /// </summary>
    private static int WidthOf(int column, string[][] rows) =>
        Headings[column].Split(' ').Concat(rows.Select(row => row[column])).Max(text => text.Length);

    private static Table TableOf(int[] columns, string[][] rows)
    {
        Table table = new() { Border = TableBorder.Horizontal };
        foreach (int column in columns)
        {
            table.AddColumn(new TableColumn(Markup.Escape(Headings[column])).RightAligned().PadLeft(0).PadRight(1).Width(WidthOf(column, rows)));
        }

        foreach (string[] row in rows)
        {
            table.AddRow(columns.Select(column => new Text(row[column])).ToArray());
        }

        return table;
    }

    internal static string[] Cells(SweepOutcome o) =>
    [
        Text(o.Cell.Clients), Text(o.Cell.RateBitsPerSecond / 1000.0), Text(o.Cell.QueueMilliseconds), o.Cell.HasDips ? "yes" : "", Text(o.Cell.EventsPerSecond),
        string.Create(CultureInfo.InvariantCulture, $"{100 * o.LoadShare:0} %"), Text(o.OfferedBytesPerSecond), Text(o.DeliveredBytesPerSecond), Text(o.SentBytesPerSecond),
        Text(o.IdleRoundTripMs), Text(o.RoundTripP50Ms), Text(o.RoundTripP99Ms), Text(o.Refused), Text(o.Lost), Text(o.Differed),
        string.Create(CultureInfo.InvariantCulture, $"{Math.Floor(100 * o.ComparedShare):0} %"), Text(o.Copies), Text(o.TooSlow),
    ];

    internal static IEnumerable<string> Footnotes(IReadOnlyList<SweepOutcome> outcomes)
    {
        yield return $"Offered and delivered: what a client is to hear of, in bytes of entries. Sent: what the host sent it, datagrams with UDP and IP. Load: what the events need at"
            + " least, of what the link carries in its dips. Round trips are the client's, as it measures them; idle is before the first event.";
        string least = string.Create(CultureInfo.InvariantCulture, $"{100 * SweepOutcome.MinComparedShare:0} %");
        SweepOutcome[] bad = [.. outcomes.Where(o => !o.IsGood)];
        string all = outcomes.Count == 1 ? "The one cell" : $"All {outcomes.Count} cells";
        yield return bad.Length == 0
            ? $"{all}: no accepted event lost, no state that differs, and each client compared at least {least} of the host's committed states."
            : $"{bad.Length} of {NumberText.Count(outcomes.Count, "cell")} failed. What each must show: no accepted event lost, no state that differs, and at least {least} of"
                + " the host's committed states compared by each client.";
        foreach (SweepOutcome o in bad)
        {
            yield return $"  {o.Cell}: {o.Shortfall}";
        }
    }

    private static string Text(double value) => value.ToString(Math.Abs(value) < 10 ? "0.#" : "0", CultureInfo.InvariantCulture);
}
