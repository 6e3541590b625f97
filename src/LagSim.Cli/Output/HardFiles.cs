using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Hard;

namespace LagSim.Cli.Output;

/// <summary>The hard cases as files: a CSV with a row for each check, and a page with the derivation of each bound.</summary>
internal static class HardFiles
{
    internal static void Write(string folder, HardReport report)
    {
        Directory.CreateDirectory(folder);
        using (StreamWriter file = new(Path.Combine(folder, "hard.csv")))
        {
            CsvFile csv = new(file, "case", "size", "error", "error_kind", "bound", "passed", "modelled", "reference", "argument", "note");
            foreach (HardRow row in report.Rows)
            {
                csv.WriteRow(row.Case, row.Size, row.Error, row.ErrorKind, row.Bound, row.Passed, row.IsModelled, row.Reference, row.Argument, row.Note);
            }
        }

        HtmlReport page = new(
            "LagSim: hard cases", HardTables.Title(report) + ".", new ReportFooter("lagsim", ToolVersion.Text, report.Seed, null));
        foreach (string line in HardTables.Footnotes(report))
        {
            page.AddParagraph(line);
        }

        foreach (IGrouping<string, HardRow> rows in report.Rows.GroupBy(row => row.Case))
        {
            HardCases.TryGet(rows.Key, out IHardCase? found);
            page.AddHeading($"{rows.Key}: {found!.Title}");
            page.AddTable(new ReportTable("", [.. HardTables.Headings.Skip(1)], [.. rows.Select(IReadOnlyList<string> (row) => HardTables.Cells(report, row)[1..])]));
            page.AddTable(new ReportTable(
                "", ["of what", "bound", "reference"],
                    [.. rows.DistinctBy(row => (row.ErrorKind, row.Argument))
                    .Select(IReadOnlyList<string> (row) => [row.ErrorKind, row.Argument, row.Reference])]));
            foreach (HardRow row in rows.Where(row => row.Note.Length > 0))
            {
                page.AddParagraph($"{row.Size}: {row.Note}");
            }
        }

        page.Save(Path.Combine(folder, "report.html"));
    }
}
