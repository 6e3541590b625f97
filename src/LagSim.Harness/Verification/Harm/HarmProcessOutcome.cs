using System.Collections.Generic;

namespace LagSim.Harness.Verification.Harm;

/// <summary>What came of one attack that was played with processes.</summary>
/// <param name="Case">Which.</param>
/// <param name="LateSeconds">The furthest that the host's world, or another's, was behind real time, in seconds.</param>
/// <param name="Sentence">What the host said when it sent the player away; empty if it did not.</param>
/// <param name="Compared">How many committed states of others were held against the host's.</param>
/// <param name="Failures">Why the run fails, a sentence for each reason; empty if it passes.</param>
public sealed record HarmProcessOutcome(HarmCase Case, double LateSeconds, string Sentence, long Compared, IReadOnlyList<string> Failures)
{
    /// <summary>Whether all is as it should be.</summary>
    public bool IsGood => Failures.Count == 0;
}
