using System;

namespace LagSim.Rules;

/// <summary>What calls before one have done at its tick. It follows from the call before alone, so that a tick costs as much as it has
/// calls.</summary>
internal readonly struct RuleTally
{
    /// <summary>How many rounds of one tick rules may cause: 64. What bounces between rules and itself needs a few.</summary>
    internal const int MaxRounds = 64;

    /// <summary>How many acts rules may make in one tick: as many as calls for all timers that may be set can make, 16,384. Where each act
    /// brings a call that acts twice, their number doubles in a round, and <see cref="MaxRounds"/> is never reached.</summary>
    internal const int MaxActs = RuleWorld.MaxTimers * RuleWorld.MaxActs;

    /// <summary>How many calls of one tick are made for contacts and crossings, all others counted too: 65,536. An instant of
    /// many bodies that is closed after its rounds has fewer; what rattles on must not end the rules that hear it.</summary>
    internal const int MaxCalls = 1 << 16;

    private readonly int calls;
    private readonly int acts;
    private readonly int rounds; // rounds before its own in which a call caused something
    private readonly bool hasCaused; // whether one of its own round has

    private RuleTally(uint first, int calls, int acts, int rounds, bool hasCaused, bool hasEnded)
    {
        First = first;
        this.calls = calls;
        this.acts = acts;
        this.rounds = rounds;
        this.hasCaused = hasCaused;
        HasEnded = hasEnded;
    }

    /// <summary>The number of the call's first act: how many acts there are of its tick and round.</summary>
    internal uint First { get; }

    /// <summary>Whether a call before it wanted to do more in this tick than rules may.</summary>
    internal bool HasEnded { get; }

    /// <summary>Whether there were so many calls that contacts and crossings are not heard any more.</summary>
    internal bool IsDeaf => calls >= MaxCalls;

    /// <summary>How many acts there may still be in this tick: none after as many rounds as rules may cause.</summary>
    internal int ActsLeft => rounds >= MaxRounds ? 0 : MaxActs - acts;

    /// <summary>What is before a call.</summary>
    /// <param name="call">The call.</param>
    /// <param name="previous">The one before it, with its own tally; null for none.</param>
    internal static RuleTally Before(RuleCall call, RuleCall? previous)
    {
        if (previous is null || previous.Key.Time != call.Key.Time)
        {
            return default;
        }

        RuleTally before = previous.Before;
        bool hasCaused = before.hasCaused || previous.Chains;
        int calls = before.calls + 1;
        int acts = before.acts + previous.Acts.Count;
        bool hasEnded = before.HasEnded || previous.Dropped > 0;
        return previous.Key.Round == call.Key.Round
            ? new RuleTally(before.First + (uint)previous.Acts.Count, calls, acts, before.rounds, hasCaused, hasEnded)
            : new RuleTally(0, calls, acts, before.rounds + (hasCaused ? 1 : 0), false, hasEnded);
    }

    /// <summary>Whether a call would do the same after what another tally counts.</summary>
    internal bool IsAsGoodAs(in RuleTally other) =>
        First == other.First && HasEnded == other.HasEnded && IsDeaf == other.IsDeaf
        && Math.Min(ActsLeft, RuleWorld.MaxActs + 1) == Math.Min(other.ActsLeft, RuleWorld.MaxActs + 1);
}
