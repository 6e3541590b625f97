using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>The progress of a rollback: what is known beyond the current event, and since when.</summary>
/// <remarks>Not thread-safe. The event loop moves the cursor from event to event; all else is changed by the rollback.</remarks>
internal sealed class RollbackState
{
    private uint[] healedIn = Array.Empty<uint>(); // by slot: the number of the last rollback that touched the body

    /// <summary>What the current rollback re-simulates. A rollback may be finished in several advances.</summary>
    internal RollbackKind Kind { get; private set; }

    /// <summary>
    /// The rollback horizon: how far the world was simulated before the current rollback, and so how far the paths of bodies that nothing
    /// late has touched are known. Only while a rollback is under way.
    /// </summary>
    internal SimTime Horizon { get; private set; }

    /// <summary>The current event, or the key that was rewound to; between advances no earlier than what comes next.</summary>
    internal EventKey Cursor { get; set; }

    /// <summary>Segments up to this serial are from before the current rollback. Only in one of the causal cone.</summary>
    internal long LastOld { get; private set; }

    /// <summary>The number of bodies that the current rollback has touched.</summary>
    internal int BodyCount { get; private set; }

    /// <summary>
    /// The number of the current rollback, or of the last one; 1 before the first, so that no rollback has touched a new slot.
    /// </summary>
    internal uint Number { get; private set; } = 1;

    /// <summary>How often timelines were rewound for a late event.</summary>
    internal long Count { get; private set; }

    /// <summary>How many segments were cut off by rollbacks, to be simulated again.</summary>
    internal long SegmentsCut { get; set; }

    /// <summary>Whether a rollback is under way.</summary>
    internal bool IsActive => Kind != RollbackKind.None;

    /// <summary>
    /// What neighbour lists know the current heal by, while bodies' paths may be known beyond the current event; else 0.
    /// </summary>
    internal long HealNumber => MayBeKnownBeyond(Cursor) ? Count : 0;

    /// <summary>Whether bodies' paths may be known beyond a key.</summary>
    internal bool MayBeKnownBeyond(in EventKey key) => Kind == RollbackKind.CausalCone && key.Time <= Horizon;

    /// <summary>A late event has come, whether or not a rollback is under way.</summary>
    internal void CountLate() => Count++;

    /// <summary>A rollback begins in a world that was simulated so far.</summary>
    internal void Begin(RollbackKind kind, SimTime horizon)
    {
        Kind = kind;
        Horizon = horizon;
        Number++;
        BodyCount = 0;
    }

    /// <summary>From now on the current rollback re-simulates only what depends on late events.</summary>
    /// <param name="lastOld">The serial of the newest segment. What the rollback has remade so far may lie beyond the event, too.</param>
    internal void BecomeCausalCone(long lastOld)
    {
        Kind = RollbackKind.CausalCone;
        LastOld = lastOld;
    }

    /// <summary>From now on the current rollback, if there is one, re-simulates all bodies.</summary>
    internal void BecomeFull() => Kind = IsActive ? RollbackKind.Full : RollbackKind.None;

    /// <summary>
    /// All before a key has happened, and predictions begin there. From the last event on, which may be long ago, the broad phase would ask
    /// to be looked at again at an instant that is over; a heal would go back to it, and take its late event for done.
    /// </summary>
    internal void MoveOn(in EventKey key) => Cursor = EventKey.Compare(key, Cursor) > 0 ? key : Cursor;

    /// <summary>The current rollback is done.</summary>
    internal void End() => Kind = RollbackKind.None;

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
