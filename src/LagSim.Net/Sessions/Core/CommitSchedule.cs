using System;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>The instants whose committed state is hashed, the same on every peer, and the newest of those states.</summary>
internal sealed class CommitSchedule
{
    private const int Kept = 64;

    private readonly CommittedState?[] own = new CommittedState?[Kept];
    private readonly (SimTime Time, ulong StateHash)[] heard = new (SimTime, ulong)[Kept];
    private readonly SimTime start;
    private readonly SimDuration interval;

    /// <param name="start">The session's start.</param>
    /// <param name="from">The first instant that this peer can read: the beginning of its world.</param>
    /// <param name="interval">The time from one instant to the next.</param>
    internal CommitSchedule(SimTime start, SimTime from, SimDuration interval)
    {
        this.start = start;
        this.interval = interval;
        long passed = (from - start).Ticks / interval.Ticks;
        Next = start + (interval * (passed + 1));
        Array.Fill(heard, (SimTime.MinValue, 0UL));
    }

    /// <summary>The next instant to hash.</summary>
    internal SimTime Next { get; private set; }

    /// <summary>Skips the instants before a time, which can no longer be hashed.</summary>
    internal void SkipTo(SimTime time)
    {
        if (Next < time)
        {
            Next += interval * (((time - Next).Ticks + interval.Ticks - 1) / interval.Ticks);
        }
    }

    /// <summary>Hashes the next instant and moves on.</summary>
    internal CommittedState Take(Simulation world)
    {
        CommittedState state = new(Next, world.StateHash(Next), world.EventHash(Next));
        own[Place(Next)] = state;
        Next += interval;
        return state;
    }

    /// <summary>Looks up the hash of an instant; false if it was not hashed, or too long ago.</summary>
    internal bool TryGet(SimTime time, out ulong stateHash)
    {
        CommittedState? state = time > start ? own[Place(time)] : null;
        stateHash = state?.StateHash ?? 0;
        return state?.Time == time;
    }

    /// <summary>The time from one instant to the next.</summary>
    internal SimDuration Interval => interval;

    /// <summary>Records a hash from the host; true if it can be compared now, with the own state to compare it with.</summary>
    internal bool TryCompare(SimTime time, ulong stateHash, out CommittedState mine)
    {
        mine = default;
        if (time <= start || (time - start).Ticks % interval.Ticks != 0)
        {
            return false;
        }

        ref (SimTime Time, ulong StateHash) last = ref heard[Place(time)];
        if (last.Time == time)
        {
            return false; // received before, and compared or waiting
        }

        last = (time, stateHash);
        mine = own[Place(time)] ?? default;
        return own[Place(time)]?.Time == time;
    }

    /// <summary>Looks up the host's earlier hash for a state just taken; false if there is none.</summary>
    internal bool TryCompare(in CommittedState mine, out ulong stateHash)
    {
        (SimTime time, stateHash) = heard[Place(mine.Time)];
        return time == mine.Time;
    }

    private int Place(SimTime time) => (int)((time - start).Ticks / interval.Ticks % Kept);
}
