using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>On which segment of its path a body comes to an event, whether or not its path is known beyond it.</summary>
internal sealed class PathView(TimelineStore timelines, RollbackState rollback, TestFaults faults)
{
    /// <summary>
    /// The piece of its path on which a body meets an impact of this tick and round: its newest, unless it is ahead, with what it did
    /// before the heal from there on still standing.
    /// </summary>
    internal int PieceAt(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        if (!rollback.MayBeKnownBeyond(key) || timelines.Serial(last) > rollback.LastOld || IsOverlooked(slot))
        {
            return last;
        }

        return timelines.Before(slot, EventKey.BeforeImpacts(key.Time, key.Round));
    }

    /// <summary>
    /// The first piece of another's path that a body's newest segment can still meet: the newest, but for one who is ahead.
    /// </summary>
    internal int PieceFrom(int slot, int other)
    {
        int piece = timelines.Last(other);
        if (faults.Has(HealingFault.ForgetsThePast) || IsOverlooked(other))
        {
            return piece;
        }

        ref readonly EventKey opened = ref timelines.Key(timelines.Last(slot));
        EventKey from = EventKey.Compare(opened, rollback.Cursor) > 0 ? opened : rollback.Cursor;
        while (timelines.Serial(piece) <= rollback.LastOld && EventKey.Compare(timelines.Key(piece), from) > 0 && timelines.Previous(piece) != TimelineStore.None)
        {
            piece = timelines.Previous(piece);
        }

        return piece;
    }

    /// <summary>The piece on which a body comes to an event.</summary>
    internal int PieceBefore(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        return last != TimelineStore.None && EventKey.Compare(timelines.Key(last), key) < 0 ? last : timelines.Before(slot, key);
    }

    private bool IsOverlooked(int slot) => faults.Has(HealingFault.OverlooksWhoIsAhead) && rollback.HasTouched(slot);
}
