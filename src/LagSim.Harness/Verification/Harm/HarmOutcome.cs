using System.Collections.Generic;

namespace LagSim.Harness.Verification.Harm;

/// <summary>The result of one attack.</summary>
public sealed record HarmOutcome
{
    /// <summary>The attack.</summary>
    public required HarmCase Case { get; init; }

    /// <summary>The furthest that the host's or another player's world fell behind real time, in seconds.</summary>
    public double LateSeconds { get; init; }

    /// <summary>
    /// How long the attacker stayed after the first of these worlds was more than 250 ms behind, in seconds; null if it stayed to the end,
    /// or if none was.
    /// </summary>
    public double? OutSeconds { get; init; }

    /// <summary>How long all worlds took to return to real time after that, in seconds; null if none was behind.</summary>
    public double? BackSeconds { get; init; }

    /// <summary>Whether the attacker was disconnected.</summary>
    public bool IsExpelled { get; init; }

    /// <summary>The host's message about it; empty if there is none.</summary>
    public string Sentence { get; init; } = "";

    /// <summary>The largest fraction of its budget that an honest player used.</summary>
    public double HonestPart { get; init; }

    /// <summary>The reasons why the run fails, a sentence each; empty if it passes.</summary>
    public IReadOnlyList<string> Failures { get; init; } = [];

    /// <summary>Whether the run passes.</summary>
    public bool IsGood => Failures.Count == 0;
}
