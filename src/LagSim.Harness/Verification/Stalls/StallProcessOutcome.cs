using System.Collections.Generic;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>What came of one session with stalls that was played with real processes.</summary>
/// <param name="Case">What was drawn.</param>
/// <param name="Compared">How many committed states of clients were held against the host's of the same time.</param>
/// <param name="Differed">How many of them were not the host's.</param>
/// <param name="Failures">What is not as it should be, as sentences.</param>
public sealed record StallProcessOutcome(StallCase Case, long Compared, long Differed, IReadOnlyList<string> Failures)
{
    /// <summary>Whether all is as it should be.</summary>
    public bool IsGood => Failures.Count == 0 && Differed == 0 && Compared > 0;
}
