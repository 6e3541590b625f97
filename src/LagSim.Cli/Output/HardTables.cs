using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Hard;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The hard cases as a table for a terminal.</summary>
internal static class HardTables
{
    internal static IReadOnlyList<string> Headings { get; } = ["case", "error", "bound", "outcome", "of what"];

    internal static void Write(ToolConsole console, HardReport report, string? folder)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   hard   seed {report.Seed}");
        if (console.IsEndless)
        {
            WriteLines(console.Output, report);
        }
        else
        {
            console.Write(AsTable(report));
        }

        foreach (string line in Footnotes(report))
        {
            console.Output.WriteLine(line);
        }

        if (folder is not null)
        {
            console.Output.WriteLine($"CSV and report.html, with the argument for each bound, are in {folder}.");
        }
    }

    internal static string Title(HardReport report) => report.AreControls
        ? "deliberately wrong methods, by the checks of the hard cases: each must fail"
        : $"hard cases, {(report.Scale == HardScale.Full ? "full" : "small")} sizes";

    internal static string[] Cells(HardReport report, HardRow row) =>
        [row.Case, Text(row.Error), Text(row.Bound), report.Outcome(row),
            $"{Kind(row.ErrorKind)}: {row.Size}{(report.AreControls ? $"; the wrong method: {row.Note}" : "")}"];

    internal static IEnumerable<string> Footnotes(HardReport report)
    {
        if (report.StoppedAt is string stopped)
        {
            yield return $"stopped early, at {stopped}: it and what comes after it has no rows";
        }

        int all = report.Rows.Count, right = report.AsItShouldBe;
        string outcome = !report.AreControls ? all == 1 ? $"{right} of 1 row within its bound" : $"{right} of {all} rows within their bound"
            : right == all ? $"All {all} checks of wrong methods failed, as they must: none was taken for right"
            : $"{right} of {all} checks of wrong methods failed, as all of them must; NOT caught: {all - right}, named below";
        yield return string.Create(
            CultureInfo.InvariantCulture,
            $"{outcome}; {report.WallSeconds:0.0} s. Each bound is argued from rounding, ticks or a method's order: --json and --out say how.");
        foreach (HardRow row in report.Rows.Where(row => row.Passed == report.AreControls))
        {
            string note = row.Note.Length > 0 ? $" ({row.Note})" : "";
            yield return
                $"{report.Outcome(row)}: {row.Case}, {row.Size}{note}: {Text(row.Error)} is {(row.Passed ? "" : "not ")}within {Text(row.Bound)},"
                    + $" {Kind(row.ErrorKind)}";
        }
    }

    /// <summary>Writes a line for each row, of any length, with the long text last, so that a narrow window breaks nothing else.</summary>
    private static void WriteLines(TextWriter output, HardReport report)
    {
        string[][] rows = [[.. Headings], .. report.Rows.Select(row => Cells(report, row))];
        int[] widths = [.. Enumerable.Range(0, Headings.Count - 1).Select(column => rows.Max(row => row[column].Length))];
        output.WriteLine(Title(report));
        foreach (string[] row in rows)
        {
            output.WriteLine($"{row[0].PadRight(widths[0])}  {row[1].PadLeft(widths[1])}  {row[2].PadLeft(widths[2])}  {row[3].PadRight(widths[3])}  {row[4]}");
        }
    }

    /// <summary>Returns a table of which only the last column, a text, is wrapped.</summary>
    private static Table AsTable(HardReport report)
    {
        Table table = DropTables.NewTable(Title(report), [.. Headings]);
        table.Columns[3].Alignment = Justify.Left;
        (table.Columns[4].NoWrap, table.Columns[4].Alignment) = (false, Justify.Left);
        foreach (HardRow row in report.Rows)
        {
            table.AddRow([.. Cells(report, row).Select(Markup.Escape)]);
        }

        return table;
    }

    /// <summary>Returns a kind of error in words, with its unit in brackets: <c>speed_m_per_s</c> is speed (m/s).</summary>
    private static string Kind(string kind)
    {
        foreach ((string suffix, string unit) in new[]
            { ("_m_per_s", "m/s"), ("_rad_per_s", "rad/s"), ("_rad", "rad"), ("_m", "m"), ("_s", "s"), ("_j", "J"), ("_relative", "relative") })
        {
            if (kind.EndsWith(suffix, StringComparison.Ordinal))
            {
                return $"{kind[..^suffix.Length].Replace('_', ' ')} ({unit})";
            }
        }

        return kind.Replace('_', ' ');
    }

    private static string Text(double value) => double.IsNaN(value) ? "none" : NumberText.Short(value);
}
