using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>On which segment of its path a body comes to an event, whether or not its path is known beyond it.</summary>
internal class SegmentLookup(TimelineStore timelines, RollbackState rollback)
{
    /// <summary>
    /// The segment on which a body meets an impact of this tick and round: its newest, unless it is ahead, with what it did
    /// before the heal from there on still standing.
    /// </summary>
    internal int SegmentAt(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        return !rollback.MayBeKnownBeyond(key) || timelines.Serial(last) > rollback.LastOld ? last : PastSegmentAt(slot, key);
    }

    /// <summary>
    /// The first segment of another body that a body's newest segment can still meet at or after the current event: the newest, unless
    /// that body is ahead.
    /// </summary>
    internal int SegmentFrom(int slot, int other)
    {
        int segment = timelines.Last(other);
        return slot == other || !rollback.MayBeKnownBeyond(rollback.Cursor) || timelines.Serial(segment) > rollback.LastOld
            ? segment
            : PastSegmentFrom(slot, segment);
    }

    /// <summary>The segment on which a body comes to an event.</summary>
    internal int SegmentBefore(int slot, in EventKey key)
    {
        int last = timelines.Last(slot);
        return last != TimelineStore.None && EventKey.Compare(timelines.Key(last), key) < 0 ? last : timelines.Before(slot, key);
    }

    /// <summary>
    /// From where on paths are met. Impacts of one round are one instant: when a heal meets the first of them, or rules are called for it,
    /// another may still be to come, which meets a body on the segment that the first one ends.
    /// </summary>
    private protected virtual EventKey Now => rollback.Cursor.Kind == EventKind.Impact
        ? EventKey.BeforeImpacts(rollback.Cursor.Time, rollback.Cursor.Round) : rollback.Cursor;

    /// <summary>The first segment that can still be met of another body that may be ahead, whose newest segment is given.</summary>
    private protected virtual int PastSegmentFrom(int slot, int piece)
    {
        ref readonly EventKey opened = ref timelines.Key(timelines.Last(slot));
        EventKey now = Now;
        EventKey from = EventKey.Compare(opened, now) > 0 ? opened : now;
        while (timelines.Serial(piece) <= rollback.LastOld && EventKey.Compare(timelines.Key(piece), from) > 0 && timelines.Previous(piece) != TimelineStore.None)
        {
            piece = timelines.Previous(piece);
        }

        return piece;
    }

    /// <summary>The segment on which a body that is ahead meets an impact: what it did before the late event came.</summary>
    private protected virtual int PastSegmentAt(int slot, in EventKey key) =>
        timelines.Before(slot, EventKey.BeforeImpacts(key.Time, key.Round));
}
