using System.Collections.Generic;

namespace LagSim.Harness.Verification.Harm;

/// <summary>What became of honest players whose host got little time.</summary>
/// <param name="Case">The session.</param>
/// <param name="LateSeconds">The furthest that the host's world fell behind real time, in seconds: that it was starved at all.</param>
/// <param name="Accepted">How many of the players' actions the host accepted.</param>
/// <param name="Failures">Who did not stay, and why, a sentence each; empty if all did.</param>
public sealed record StarvedOutcome(StarvedCase Case, double LateSeconds, long Accepted, IReadOnlyList<string> Failures)
{
    /// <summary>Whether all players stayed.</summary>
    public bool IsGood => Failures.Count == 0;
}
