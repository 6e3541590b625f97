using System.Collections.Generic;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>The result of one session with stalls played with real processes.</summary>
/// <param name="Case">The session as drawn.</param>
/// <param name="Compared">The number of committed states of clients that were compared with the host's of the same time.</param>
/// <param name="Differed">The number of those that differ from the host's.</param>
/// <param name="Failures">The failures, as sentences.</param>
public sealed record StallProcessOutcome(StallCase Case, long Compared, long Differed, IReadOnlyList<string> Failures)
{
    /// <summary>Whether the session passes.</summary>
    public bool IsGood => Failures.Count == 0 && Differed == 0 && Compared > 0;
}
