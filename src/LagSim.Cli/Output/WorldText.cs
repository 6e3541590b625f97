using System;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Worlds;

namespace LagSim.Cli.Output;

/// <summary>A check of single worlds as lines of text.</summary>
internal static class WorldText
{
    private const int MaxNamed = 20;

    /// <summary>Writes the result; nothing if no world was played.</summary>
    internal static void Write(TextWriter output, WorldOptions? options, WorldReport? report)
    {
        if (options is null || report is null)
        {
            return;
        }

        CultureInfo culture = CultureInfo.InvariantCulture;
        string stopped = report.IsStopped ? "stopped early: " : "";
        output.WriteLine(string.Create(culture,
            $"{stopped}{report.Outcomes.Count:N0} of {NumberText.Count(report.AskedFor, "world", "N0")} played from seed"
            + $" {options.Seed} in {report.WallSeconds:0.0} s"));
        output.WriteLine(string.Create(culture,
            $"ended {report.CountOf(WorldFailureKind.Ended):N0}; differing {report.CountOf(WorldFailureKind.Differs):N0};"
            + $" broken promises {report.CountOf(WorldFailureKind.Promise):N0}; unfinished {report.Outcomes.Count(o => o.IsUnfinished):N0}"));
        foreach (IGrouping<WorldKind, WorldOutcome> kind in report.Outcomes.GroupBy(o => o.Kind).OrderBy(g => g.Key))
        {
            string[] failures =
            [
                Part(kind.Count(o => o.FailureKind == WorldFailureKind.Ended), "ended"),
                    Part(kind.Count(o => o.FailureKind == WorldFailureKind.Differs), "differing"),
                .. kind.Where(o => o.Promise.Length > 0).GroupBy(o => o.Promise).OrderBy(g => g.Key, StringComparer.Ordinal)
                    .Select(g => Part(g.Count(), g.Key)),
                Part(kind.Count(o => o.IsUnfinished), "unfinished"), Part(kind.Count(o => o.HasFullTimelines), "full"),
                    Part(kind.Sum(o => o.LostBodies), "bodies lost"),
            ];
            string told = string.Join(", ", failures.Where(f => f.Length > 0));
            output.WriteLine(string.Create(culture, $"  {kind.Key,-14} {kind.Count(),6:N0}  {told}").TrimEnd());
        }

        string[] unfinished = [.. report.Outcomes.Where(o => o.IsUnfinished).Select(o => o.Seed.ToString(culture))];
        if (unfinished.Length > 0)
        {
            string more = unfinished.Length > MaxNamed ? " and more" : "";
            output.WriteLine($"unfinished seeds: {string.Join(", ", unfinished.Take(MaxNamed))}{more}");
        }

        WorldOutcome[] failed = [.. report.Failures];
        foreach (WorldOutcome world in failed.Take(MaxNamed))
        {
            output.WriteLine();
            output.WriteLine(string.Create(culture, $"seed {world.Seed}, {world.Kind}: {world.Failure}"));
            if (world.Difference is not null)
            {
                output.WriteLine($"  first difference: {world.Difference}");
            }

            foreach (string act in world.LeastActs)
            {
                output.WriteLine($"  {act}");
            }

            output.WriteLine($"  {world.Command}");
        }

        if (failed.Length > MaxNamed)
        {
            output.WriteLine(string.Create(culture, $"and {failed.Length - MaxNamed:N0} more; --json names all"));
        }
    }

    private static string Part(int number, string what) => number == 0 ? ""
        : string.Create(CultureInfo.InvariantCulture, $"{number:N0} {what}");
}
