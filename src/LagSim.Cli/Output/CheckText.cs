using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Check;
using LagSim.Testing;

namespace LagSim.Cli.Output;

/// <summary>A check as lines of text.</summary>
internal static class CheckText
{
    private const int MaxNamed = 20;

    internal static void Write(TextWriter output, CheckOptions options, CheckReport report, string? folder)
    {
        CultureInfo culture = CultureInfo.InvariantCulture;
        string stopped = report.IsStopped ? "stopped early: " : "";
        output.WriteLine(string.Create(culture, $"{stopped}{report.Outcomes.Count:N0} of {Count(report.AskedFor, "session")} played from seed {options.Seed}"
            + $" in {report.WallSeconds:0.0} s"));
        if (report.StoppedSeeds.Count > 0)
        {
            string seeds = string.Join(", ", report.StoppedSeeds);
            output.WriteLine(report.StoppedSeeds.Count == 1
                ? $"stopped in the middle of the session of seed {seeds}, which is not counted; lagsim check --sessions 1 --seed {seeds} plays it"
                : $"stopped in the middle of the sessions of seeds {seeds}, which are not counted; lagsim check --sessions 1 --seed {report.StoppedSeeds[0]}"
                    + " plays the first");
        }

        output.WriteLine(string.Create(culture, $"{Count(report.ExternalEvents, "external event")}, late {Count(report.LateEvents, "time")};"
            + $" {Count(report.Events, "event")} in all worlds"));
        double changed = report.Heals == 0 ? 0 : 100.0 * report.HealsThatChangedAnImpact / report.Heals;
        output.WriteLine(string.Create(culture, $"{Count(report.Heals, "heal")}, of which {report.HealsThatChangedAnImpact:N0} ({changed:0.0} %) changed an"
            + $" impact; too late {report.TooLateEvents:N0}"));
        output.WriteLine(string.Create(culture, $"{Count(report.Outcomes.Count(o => o.HasFullLinks), "session")} on full links,"
            + $" {report.Outcomes.Count(o => o.HasStops):N0} with a stop; {Count(report.Outcomes.Sum(o => o.Copies), "fresh copy", "fresh copies")};"
            + $" lost {report.LostEvents:N0}"));
        output.WriteLine(string.Create(culture, $"differing bits {report.DifferingBits:N0}; failing seeds {report.Failures.Count:N0}"));
        if (report.UnfinishedSeeds.Any())
        {
            string seeds = string.Join(", ", report.UnfinishedSeeds);
            output.WriteLine(string.Create(culture, $"unfinished, of more than {options.MaxEvents:N0} events: seeds {seeds}"));
        }

        if (Shrunk(report) is string shrunk)
        {
            output.WriteLine(shrunk);
        }

        for (int n = 0; n < report.Failures.Count && n < MaxNamed; n++)
        {
            CheckFailure failure = report.Failures[n];
            output.WriteLine();
            output.WriteLine(string.Create(culture, $"seed {failure.Whole.Seed}: {failure.Whole.Failure}"));
            if (failure.Least.Difference is FirstDifference difference)
            {
                output.WriteLine($"  first difference{(failure.IsShrunk ? " of the least that fails" : "")}: {difference}");
            }
            else if (failure.Least.Failure != failure.Whole.Failure)
            {
                output.WriteLine($"  the least that fails: {failure.Least.Failure}");
            }

            output.WriteLine($"  {failure.Command}");
        }

        if (report.Failures.Count > MaxNamed)
        {
            output.WriteLine(string.Create(culture, $"and {report.Failures.Count - MaxNamed:N0} more; --json names all"));
        }

        if (folder is not null)
        {
            output.WriteLine($"files in {folder}");
        }
    }

    private static string Count(long number, string thing, string? many = null) => NumberText.Count(number, thing, "N0", many);

    /// <summary>Returns which failing sessions were shrunk, if not all of them were.</summary>
    internal static string? Shrunk(CheckReport report)
    {
        string[] shrunk = [.. report.Failures.Where(f => f.IsShrunk).Select(f => $"{f.Whole.Seed}")];
        CheckFailure[] others = [.. report.Failures.Where(f => !f.IsShrunk)];
        if (others.Length == 0)
        {
            return null;
        }

        string done = shrunk.Length == 0 ? "no failing seed shrunk" : $"{(shrunk.Length == 1 ? "seed" : "seeds")} {string.Join(", ", shrunk)} shrunk";
        string left = string.Create(CultureInfo.InvariantCulture, $"{Count(others.Length, $"{(shrunk.Length == 0 ? "" : "more ")}failing seed")} not shrunk");
        return $"{done}; {left}: {others[0].Command} shrinks {(others.Length == 1 ? "it" : "the first of them")}";
    }
}
