using System.Collections.Generic;

namespace LagSim.Harness.Verification.Harm;

/// <summary>The result of one attack played with processes.</summary>
/// <param name="Case">The attack.</param>
/// <param name="LateSeconds">The furthest that the host's or another player's world fell behind real time, in seconds.</param>
/// <param name="Sentence">The host's message when it disconnected the attacker; empty if it did not.</param>
/// <param name="Compared">The number of committed states of other players that were compared with the host's.</param>
/// <param name="Failures">The reasons why the run fails, a sentence each; empty if it passes.</param>
public sealed record HarmProcessOutcome(HarmCase Case, double LateSeconds, string Sentence, long Compared, IReadOnlyList<string> Failures)
{
    /// <summary>Whether the run passes.</summary>
    public bool IsGood => Failures.Count == 0;
}
