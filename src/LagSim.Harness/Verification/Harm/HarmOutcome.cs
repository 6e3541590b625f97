using System.Collections.Generic;

namespace LagSim.Harness.Verification.Harm;

/// <summary>What came of one attack.</summary>
public sealed record HarmOutcome
{
    /// <summary>What was drawn.</summary>
    public required HarmCase Case { get; init; }

    /// <summary>The furthest that another's world, or the host's, was behind real time, in seconds.</summary>
    public double LateSeconds { get; init; }

    /// <summary>How long after the first of these worlds was late by more than 250 ms the player was out, in seconds; null if he stayed, or none was.</summary>
    public double? OutSeconds { get; init; }

    /// <summary>How long after that all of them were in real time again, in seconds; null if they were all the while.</summary>
    public double? BackSeconds { get; init; }

    /// <summary>Whether the player was sent away.</summary>
    public bool IsExpelled { get; init; }

    /// <summary>What the host said about it; empty if nothing.</summary>
    public string Sentence { get; init; } = "";

    /// <summary>The most that an honest player used up of his budget at a time, as a part of it.</summary>
    public double HonestPart { get; init; }

    /// <summary>Why the run fails, a sentence for each reason; empty if it passes.</summary>
    public IReadOnlyList<string> Failures { get; init; } = [];

    /// <summary>Whether all is as it should be.</summary>
    public bool IsGood => Failures.Count == 0;
}
