using System.Globalization;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;

namespace LagSim.Cli.Output;

/// <summary>The result of a drop test in one sentence.</summary>
internal static class DropFindings
{
    internal static string Of(DropRun run)
    {
        ErrorStatistics before = run.Seen.Before.ToStatistics(), during = run.Seen.During.ToStatistics();
        ErrorStatistics after = run.Seen.After.ToStatistics();
        if (run.Case == DropCase.SameStart)
        {
            return before.DifferingBits == 0 ? $"No bit differed between the peers in {Samples(before)}{Stalled(before)}."
                : $"The peers differed in {Differing(before)}, by up to {NumberText.Short(before.MaxMetres)} m{Stalled(before)}.";
        }

        string until = run.Trace is { Lift: double lift, Dealt: double dealt } && during.Samples > 0 && dealt > lift
            ? $"; in the {NumberText.Short((dealt - lift) * 1000)} ms before,"
                + $" they were up to {NumberText.Short(during.MaxMetres)} m apart" : "";
        string outcome = after.DifferingBits == 0 ? $"no bit differed between the peers in {Samples(after)}"
            : $"the peers still differed in {Differing(after)}, by up to {NumberText.Short(after.MaxMetres)} m";
        return $"After the event arrived, {outcome}{Stalled(after)}{until}.";
    }

    private static string Samples(in ErrorStatistics errors) => NumberText.Count(errors.Samples, "sample", "N0");

    private static string Differing(in ErrorStatistics errors) =>
        string.Create(CultureInfo.InvariantCulture, $"{errors.DifferingBits:N0} of {errors.Samples:N0} samples");

    private static string Stalled(in ErrorStatistics errors) => errors.StalledSamples == 0 ? ""
        : string.Create(CultureInfo.InvariantCulture, $" ({errors.StalledSamples:N0} stalled)");
}
