using System;
using LagSim.Time;

namespace LagSim.Rules;

/// <summary>A timer of rules: its number, and when it is due.</summary>
internal readonly struct RuleTimer(long at, uint round, int number) : IComparable<RuleTimer>
{
    /// <summary>As the ticks since the start at which a timer is due: it never is.</summary>
    private const long Never = long.MaxValue;

    /// <summary>When it is due, in ticks since the start of the scene.</summary>
    internal long At { get; } = at;

    /// <summary>In which round of that tick.</summary>
    internal uint Round { get; } = round;

    internal int Number { get; } = number;

    /// <summary>When a timer is due that is set: <see cref="Never"/> where that does not fit.</summary>
    internal static long DueAfter(SimDuration elapsed, SimDuration after) =>
        elapsed.Ticks > Never - after.Ticks ? Never : elapsed.Ticks + after.Ticks;

    /// <summary>At which instant it is due; the latest time there is, which no world reaches, where that does not fit.</summary>
    internal SimTime Time(SimTime start) =>
        At == Never || (start > SimTime.Zero && At > long.MaxValue - start.Ticks) ? SimTime.MaxValue : start + SimDuration.FromTicks(At);

    /// <summary>By time, round and number: the order in which they are called.</summary>
    public int CompareTo(RuleTimer other)
    {
        int byTime = At.CompareTo(other.At);
        int byRound = byTime != 0 ? byTime : Round.CompareTo(other.Round);
        return byRound != 0 ? byRound : Number.CompareTo(other.Number);
    }
}
