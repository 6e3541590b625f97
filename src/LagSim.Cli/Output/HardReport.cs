using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.Hard;

namespace LagSim.Cli.Output;

/// <summary>The results of <c>lagsim hard</c>. Immutable.</summary>
/// <param name="Rows">The checks.</param>
/// <param name="Scale">How large the sizes were.</param>
/// <param name="AreControls">Whether deliberately wrong methods were run, which must fail.</param>
/// <param name="Seed">The seed of all random numbers.</param>
/// <param name="WallSeconds">How long it took.</param>
internal sealed record HardReport(IReadOnlyList<HardRow> Rows, HardScale Scale, bool AreControls, ulong Seed, double WallSeconds)
{
    /// <summary>The case at which it was interrupted, which has no rows, nor have those after it; null if it went through.</summary>
    internal string? StoppedAt { get; init; }

    /// <summary>How many rows came out as they should: passed, or for a wrong method failed.</summary>
    internal int AsItShouldBe => Rows.Count(row => row.Passed != AreControls);

    /// <summary>The word for a row's outcome; a wrong method is caught where it fails.</summary>
    internal string Outcome(HardRow row) => AreControls ? (row.Passed ? "NOT CAUGHT" : "caught")
        : row.Passed ? "passed" : row.IsModelled ? "FAILED" : "NOT MODELLED";
}
