using System;

namespace LagSim.Rules;

/// <summary>A timer of rules: its number, and when it is due.</summary>
internal readonly struct RuleTimer(long at, uint round, int number) : IComparable<RuleTimer>
{
    /// <summary>When it is due, in ticks since the start of the scene.</summary>
    internal long At { get; } = at;

    /// <summary>In which round of that tick.</summary>
    internal uint Round { get; } = round;

    internal int Number { get; } = number;

    /// <summary>By time, round and number: the order in which they are called.</summary>
    public int CompareTo(RuleTimer other)
    {
        int byTime = At.CompareTo(other.At);
        int byRound = byTime != 0 ? byTime : Round.CompareTo(other.Round);
        return byRound != 0 ? byRound : Number.CompareTo(other.Number);
    }
}
