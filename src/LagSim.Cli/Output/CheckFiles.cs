using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Check;

namespace LagSim.Cli.Output;

/// <summary>A check as files: a CSV with a row for each session, and a page with the totals and the failures.</summary>
internal static class CheckFiles
{
    private static readonly string[] Columns =
    [
        "seed", "peers", "late_joiners", "leavers", "external_events", "late_events", "heals", "heals_that_changed_an_impact", "events", "events_rerun", "impacts",
        "too_late_events", "refused_events", "compared", "differing_bits", "failure",
        "full_links", "stops", "copies", "lost_events",
    ];

    internal static void Write(string folder, CheckOptions options, CheckReport report)
    {
        Directory.CreateDirectory(folder);
        using (StreamWriter file = new(Path.Combine(folder, "check.csv")))
        {
            CsvFile csv = new(file, Columns);
            foreach (CheckOutcome o in report.Outcomes)
            {
                csv.WriteRow(
                    o.Seed.ToString(CultureInfo.InvariantCulture), o.Peers, o.LateClients, o.Leavers, o.ExternalEvents, o.LateEvents, o.Heals, o.HealsThatChangedAnImpact,
                    o.Events, o.EventsRerun, o.Impacts, o.TooLateEvents, o.RefusedEvents, o.Compared, o.DifferingBits, o.Failure,
                    o.HasFullLinks ? 1 : 0, o.HasStops ? 1 : 0, o.Copies, o.LostEvents);
            }
        }

        IReadOnlyList<string>[] sums =
        [
            [report.IsStopped ? $"sessions (stopped early, of {Text(report.AskedFor)})" : "sessions", Text(report.Outcomes.Count)],
            ["external events", Text(report.ExternalEvents)],
            ["late events", Text(report.LateEvents)],
            ["heals", Text(report.Heals)],
            ["heals that changed an impact", Text(report.HealsThatChangedAnImpact)],
            ["events of too late a stamp", Text(report.TooLateEvents)],
            ["accepted events lost", Text(report.LostEvents)],
            ["fresh copies", Text(report.Outcomes.Sum(o => o.Copies))],
            ["differing bits", Text(report.DifferingBits)],
            ["failing seeds", Text(report.Failures.Count)],
        ];
        HtmlReport page = new(
            "LagSim check",
            $"Random sessions from seed {options.Seed}, {options.FromPeers} to {options.ToPeers} peers, link {options.Profile?.Name ?? "all"}, strategy"
                + $" {options.Strategy}.",
            new ReportFooter("lagsim", ToolVersion.Text, options.Seed, null));
        page.AddFinding(Finding(report));
        page.AddTable(new ReportTable("All sessions", ["what", "number"], sums));
        if (report.Failures.Count > 0)
        {
            page.AddTable(new ReportTable(
                "Failures", ["seed", "what", "shrunk", "first difference", "replay"],
                [
                    .. report.Failures.Select(IReadOnlyList<string> (f) =>
                        [$"{f.Whole.Seed}", f.Whole.Failure ?? "", f.IsShrunk ? "yes" : "no", f.Least.Difference?.ToString() ?? "", f.Command]),
                ]));
        }

        page.Save(Path.Combine(folder, "report.html"));
    }

    /// <summary>Returns the result in one sentence.</summary>
    internal static string Finding(CheckReport report)
    {
        string sessions = NumberText.Count(report.Outcomes.Count, "session", "N0");
        return report.Failures.Count > 0 ? $"{report.Failures.Count} of {sessions} failed."
            : report.Outcomes.Count == 0 ? "No session was played to its end."
            : $"No bit differed and no accepted event was lost in {sessions}.";
    }

    private static string Text(long number) => number.ToString(CultureInfo.InvariantCulture);
}
