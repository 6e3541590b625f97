using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Hard;
using LagSim.Harness.Reports;
using Spectre.Console;

namespace LagSim.Cli.Output;

/// <summary>The hard cases as a table for a person.</summary>
internal static class HardTables
{
    internal static IReadOnlyList<string> Headings { get; } = ["case", "size", "error", "bound", "of what", ""];

    internal static void Write(ToolConsole console, HardReport report, string? folder)
    {
        console.Output.WriteLine($"lagsim {ToolVersion.Text}   hard   seed {report.Seed}");
        Table table = DropTables.NewTable(Title(report), [.. Headings]);
        foreach (HardRow row in report.Rows)
        {
            table.AddRow([.. Cells(row).Select(Markup.Escape)]);
        }

        console.Write(table);
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

    internal static string[] Cells(HardRow row) => [row.Case, row.Size, Text(row.Error), Text(row.Bound), row.ErrorKind, HardReport.Outcome(row)];

    internal static IEnumerable<string> Footnotes(HardReport report)
    {
        yield return string.Create(
            CultureInfo.InvariantCulture,
            $"{report.Rows.Count(row => row.Passed)} of {report.Rows.Count} rows within their bound, {report.WallSeconds:0.0} s. Each bound is argued from rounding, ticks or a method's order: --json and --out say how.");
        foreach (HardRow row in report.Rows.Where(row => row.Passed == report.AreControls))
        {
            string note = row.Note.Length > 0 ? $" ({row.Note})" : "";
            yield return report.AreControls
                ? $"NOT CAUGHT: {row.Case}, {row.Size}{note}: {Text(row.Error)} is within {Text(row.Bound)} {row.ErrorKind}"
                : $"{HardReport.Outcome(row)}: {row.Case}, {row.Size}{note}: {Text(row.Error)} is not within {Text(row.Bound)} {row.ErrorKind}";
        }
    }

    private static string Text(double value) => double.IsNaN(value) ? "none" : NumberText.Short(value);
}
