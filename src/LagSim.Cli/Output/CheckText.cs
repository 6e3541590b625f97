using System.Globalization;
using System.IO;
using LagSim.Harness.Check;

namespace LagSim.Cli.Output;

/// <summary>A check as lines of text.</summary>
internal static class CheckText
{
    private const int MostNamed = 20;

    internal static void Write(TextWriter output, CheckOptions options, CheckReport report, string? folder)
    {
        CultureInfo culture = CultureInfo.InvariantCulture;
        string stopped = report.IsStopped ? "stopped early: " : "";
        output.WriteLine(string.Create(culture, $"{stopped}{report.Outcomes.Count:N0} of {report.AskedFor:N0} sessions played from seed {options.Seed} in {report.WallSeconds:0.0} s"));
        if (report.StoppedSeeds.Count > 0)
        {
            string seeds = string.Join(", ", report.StoppedSeeds);
            output.WriteLine(report.StoppedSeeds.Count == 1
                ? $"stopped in the middle of the session of seed {seeds}, which is not counted; lagsim check --sessions 1 --seed {seeds} plays it"
                : $"stopped in the middle of the sessions of seeds {seeds}, which are not counted; lagsim check --sessions 1 --seed {report.StoppedSeeds[0]} plays the first");
        }

        output.WriteLine(string.Create(culture, $"{report.ExternalEvents:N0} external events, heard late {report.LateEvents:N0} times; {report.Events:N0} events in all worlds"));
        double changed = report.Heals == 0 ? 0 : 100.0 * report.HealsThatChangedAnImpact / report.Heals;
        output.WriteLine(string.Create(culture, $"{report.Heals:N0} heals, of which {report.HealsThatChangedAnImpact:N0} ({changed:0.0} %) changed an impact; too late {report.TooLateEvents:N0}"));
        output.WriteLine(string.Create(culture, $"differing bits {report.DifferingBits:N0}; failing seeds {report.Failures.Count:N0}"));
        for (int n = 0; n < report.Failures.Count && n < MostNamed; n++)
        {
            CheckFailure failure = report.Failures[n];
            output.WriteLine();
            output.WriteLine(string.Create(culture, $"seed {failure.Whole.Seed}: {failure.Whole.Failure}"));
            if (failure.Least.Difference is FirstDifference difference)
            {
                output.WriteLine($"  first difference of the least that fails: {difference}");
            }
            else if (failure.Least.Failure != failure.Whole.Failure)
            {
                output.WriteLine($"  the least that fails: {failure.Least.Failure}");
            }

            output.WriteLine($"  {failure.Command}");
        }

        if (report.Failures.Count > MostNamed)
        {
            output.WriteLine(string.Create(culture, $"and {report.Failures.Count - MostNamed:N0} more; --json names all"));
        }

        if (folder is not null)
        {
            output.WriteLine($"files in {folder}");
        }
    }
}
