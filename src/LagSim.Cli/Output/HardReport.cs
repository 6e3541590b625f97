using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Verification.Hard;

namespace LagSim.Cli.Output;

/// <summary>The results of <c>lagsim hard</c>. Immutable.</summary>
/// <param name="Rows">The checks.</param>
/// <param name="Scale">The scale of the sizes.</param>
/// <param name="AreControls">Whether deliberately wrong methods were run, which must fail.</param>
/// <param name="Seed">The seed of all random numbers.</param>
/// <param name="WallSeconds">The time taken, in seconds.</param>
internal sealed record HardReport(IReadOnlyList<HardRow> Rows, HardScale Scale, bool AreControls, ulong Seed, double WallSeconds)
{
    /// <summary>The case at which it was cancelled, which has no rows, as have those after it; null if it was not.</summary>
    internal string? StoppedAt { get; init; }

    /// <summary>The number of rows with the right outcome: passed, or failed for a wrong method.</summary>
    internal int AsItShouldBe => Rows.Count(row => row.Passed != AreControls);

    /// <summary>Returns the word for a row's outcome. A wrong method is caught where it fails.</summary>
    internal string Outcome(HardRow row) => AreControls ? (row.Passed ? "NOT CAUGHT" : "caught")
        : row.Passed ? "passed" : row.IsModelled ? "FAILED" : "NOT MODELLED";
}
