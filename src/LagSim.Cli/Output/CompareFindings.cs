using System.Collections.Generic;
using System.Linq;
using LagSim.Cli.Commands;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;

namespace LagSim.Cli.Output;

/// <summary>The findings about healing against the other strategies, computed link by link.</summary>
internal sealed class CompareFindings
{
    private const string Healing = "healing";
    private const string Interpolation = CommonOptions.Interpolating;

    /// <summary>A difference of less than 1 % does not count as better.</summary>
    private const double Noticeable = 0.99;

    private readonly bool hasBoth;
    private readonly bool hasHealing;
    private readonly CompareRun[] interpolated;
    private readonly CompareRun[] healed;

    internal CompareFindings(IReadOnlyList<CompareRun> runs)
    {
        interpolated = runs.Where(run => run.Options.Strategy == Interpolation).ToArray();
        healed = runs.Where(run => run.Options.Strategy == Healing).ToArray();
        hasBoth = interpolated.Length > 0 && healed.Length > 0;
        hasHealing = healed.Length > 0 && runs.Count > healed.Length;
        BetterDuring = Where(interpolated, (other, healing) => Worst(other.Seen.During) < Noticeable * Worst(healing.Seen.During)).Select(run => run.Options.Link.Name).ToArray();
        SmootherThanHealing = Where(interpolated, (other, healing) => other.Corrections.Max < Noticeable * healing.Corrections.Max).Select(run => run.Options.Link.Name).ToArray();
        HealingWorseAfter = Where(runs, (other, healing) => IsWorse(healing.Seen.After.ToStatistics(), other.Seen.After.ToStatistics()))
            .Select(run => (run.Options.Link.Name, run.Options.Strategy)).ToArray();

        IEnumerable<CompareRun> Where(IEnumerable<CompareRun> others, System.Func<CompareRun, CompareRun, bool> isSo) =>
            others.Where(other => healed.Any(healing => healing.Options.Link.Name == other.Options.Link.Name && isSo(other, healing)));
    }

    /// <summary>
    /// Returns the links on which interpolation has the smaller largest error as seen while an event is in transit, by 1 % or more.
    /// </summary>
    internal IReadOnlyList<string> BetterDuring { get; }

    /// <summary>Returns the links on which the largest jump that interpolation shows is smaller, by 1 % or more.</summary>
    internal IReadOnlyList<string> SmootherThanHealing { get; }

    /// <summary>Returns where healing shows larger or more errors than another strategy once no event is in transit.</summary>
    internal IReadOnlyList<(string Profile, string Strategy)> HealingWorseAfter { get; }

    /// <summary>Returns the same in sentences.</summary>
    internal IEnumerable<string> Sentences()
    {
        if (hasHealing)
        {
            yield return HealingWorseAfter.Count == 0
                ? "After the events healing is nowhere worse than another strategy."
                : $"After the events healing is worse than {string.Join(", ", HealingWorseAfter.Select(w => $"{w.Strategy} on {w.Profile}"))}.";
        }

        if (hasBoth)
        {
            string links = $"{BetterDuring.Count} of {NumberText.Count(interpolated.Length, "link")}";
            yield return BetterDuring.Count == 0
                ? "While an event is on its way interpolation looks better than healing on no link here."
                : $"While an event is on its way interpolation looks better than healing on {links}: {string.Join(", ", BetterDuring)}.";
            yield return $"Its largest jump is smaller on {SmootherThanHealing.Count} of {NumberText.Count(interpolated.Length, "link")}. The price: all it"
                + " shows is old, and"
                + $" players see what they do themselves after {NumberText.Short(Median(interpolated))} ms (median), with healing after"
                + $" {NumberText.Short(Median(healed))} ms, to the next sample.";
        }
    }

    private static double Median(IEnumerable<CompareRun> runs) => Percentiles.Of(runs.Select(run => run.InputLatency.P50)).P50;

    private static double Worst(ErrorAccumulator errors) => errors.ToStatistics().MaxMetres;

    private static bool IsWorse(in ErrorStatistics healing, in ErrorStatistics other) =>
        healing.MaxMetres > other.MaxMetres || healing.DifferingBits > other.DifferingBits;
}
