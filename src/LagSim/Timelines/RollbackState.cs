using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>The progress of a rollback: what is known beyond the current event, and since when.</summary>
/// <remarks>Not thread-safe. Only the rollback changes it.</remarks>
internal sealed class RollbackState
{
    private uint[] healedIn = Array.Empty<uint>(); // by slot: the number of the last rollback that touched the body

    /// <summary>
    /// The rollback horizon: how far the world was simulated before the current rollback, and so how far the paths of bodies that nothing
    /// late has touched are known. The least time there is if there is no rollback. A rollback may be finished in several advances.
    /// </summary>
    internal SimTime Horizon { get; private set; } = SimTime.MinValue;

    /// <summary>The current event, or the key that was rewound to.</summary>
    internal EventKey Cursor { get; set; }

    /// <summary>Segments up to this serial are from before the current rollback; -1 if all that is left of them is right.</summary>
    internal long LastOld { get; set; }

    /// <summary>The number of bodies that the current rollback has touched.</summary>
    internal int BodyCount { get; private set; }

    /// <summary>The number of the current rollback, from 1.</summary>
    internal uint Number { get; private set; }

    /// <summary>How often timelines were rewound for a late event.</summary>
    internal long Count { get; private set; }

    /// <summary>How many segments were cut off by rollbacks, to be simulated again.</summary>
    internal long SegmentsCut { get; set; }

    /// <summary>The count, if some may be known beyond the current event; else 0.</summary>
    internal long AtHand => MayBeKnownBeyond(Cursor) && LastOld >= 0 ? Count : 0;

    /// <summary>Whether a rollback is under way.</summary>
    internal bool IsActive => Horizon != SimTime.MinValue;

    /// <summary>Whether bodies' paths may be known beyond a key.</summary>
    internal bool MayBeKnownBeyond(in EventKey key) => key.Time <= Horizon;

    /// <summary>A late event has come, whether or not a rollback is under way.</summary>
    internal void CountLate() => Count++;

    /// <summary>A rollback begins in a world that was simulated so far.</summary>
    internal void Begin(SimTime horizon)
    {
        Horizon = horizon;
        Number++;
        BodyCount = 0;
    }

    /// <summary>The current rollback is done.</summary>
    internal void End() => Horizon = SimTime.MinValue;

    /// <summary>Makes room for a body, which no rollback has touched.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= healedIn.Length)
        {
            Array.Resize(ref healedIn, Math.Max(slot + 1, Math.Max(4, healedIn.Length * 2)));
        }

        healedIn[slot] = 0;
    }

    /// <summary>Counts a body that the rollback touches; false if it has touched it before.</summary>
    internal bool Touch(int slot)
    {
        bool isNew = healedIn[slot] != Number;
        healedIn[slot] = Number;
        BodyCount += isNew ? 1 : 0;
        return isNew;
    }

    /// <summary>Whether the current rollback, or the last if there is none, has touched a body.</summary>
    internal bool HasTouched(int slot) => healedIn[slot] == Number;
}
