using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Sweep;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>The sweep over full links as files: a row for each cell, charts, and a page that shows them.</summary>
internal static class SweepFiles
{
    internal static void Write(string folder, SweepOptions options, IReadOnlyList<SweepOutcome> outcomes, IReadOnlyList<SweepOutcome>? beside)
    {
        Directory.CreateDirectory(folder);
        using (StreamWriter file = new(Path.Combine(folder, "sweep.csv")))
        {
            CsvFile csv = new(
                file, "clients", "events_per_s", "rate_bit_per_s", "queue_ms", "dips", "load_share", "offered_bytes_per_s", "delivered_bytes_per_s", "sent_bytes_per_s",
                "sent_up_bytes_per_s", "idle_round_trip_ms", "round_trip_p50_ms", "round_trip_p99_ms", "recovery_s", "events_done", "events_refused", "events_unanswered",
                "events_lost", "states_differed", "compared_share", "copies", "links_too_slow", "passed", "queued_s", "queued_sent_per_needed_byte");
            foreach (SweepOutcome o in outcomes)
            {
                csv.WriteRow(
                    o.Cell.Clients, o.Cell.EventsPerSecond, o.Cell.RateBitsPerSecond, o.Cell.QueueMilliseconds, o.Cell.HasDips, o.LoadShare, o.OfferedBytesPerSecond,
                    o.DeliveredBytesPerSecond, o.SentBytesPerSecond, o.SentUpBytesPerSecond, o.IdleRoundTripMs, o.RoundTripP50Ms, o.RoundTripP99Ms, o.RecoverySeconds, o.Done,
                    o.Refused, o.Unanswered, o.Lost, o.Differed, o.ComparedShare, o.Copies, o.TooSlow, o.IsGood, o.QueuedSeconds, o.SentPerNeededByteWhileQueued);
            }
        }

        using (StreamWriter table = new(Path.Combine(folder, "cells.md")))
        {
            SweepMarkdown.Write(table, outcomes, beside);
        }

        HtmlReport report = new(
            "LagSim: sessions on full links", "A host and its clients in virtual time, each client over a link of its own.", new ReportFooter("lagsim", ToolVersion.Text, options.Seed, null));
        foreach (string line in SweepTables.Footnotes(outcomes))
        {
            report.AddParagraph(line);
        }

        if (SweepChart.Of(outcomes, beside) is LineChart chart)
        {
            chart.Save(Path.Combine(folder, "sweep.svg"));
            report.AddChart(chart);
        }

        report.AddTable(new ReportTable("All cells", SweepTables.Headings, [.. outcomes.Select(IReadOnlyList<string> (o) => SweepTables.Cells(o))]));
        report.Save(Path.Combine(folder, "report.html"));
    }
}
