using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// A segment's place among the others. Apart from the segment, so that old ones are dropped without reading what they were.
/// </summary>
internal struct SegmentLinks
{
    /// <summary>When the next was opened; <see cref="SimTime.MaxValue"/> if there is none.</summary>
    internal SimTime Closed;

    /// <summary>A number that no other segment of the store ever has; 0 once it is gone.</summary>
    internal long Serial;

    internal int Previous;
    internal int Next;

    /// <summary>The slot of the body whose path it is part of.</summary>
    internal int Owner;

    /// <summary>The next in the ring of segments that one impact opened.</summary>
    internal int Together;

    /// <summary>Those of a body's newest segment, which one event opened for that body alone.</summary>
    internal static SegmentLinks OfNewest(int segment, long serial, int owner, int previous) => new()
    {
        Closed = SimTime.MaxValue,
        Serial = serial,
        Previous = previous,
        Next = TimelineStore.None,
        Owner = owner,
        Together = segment,
    };
}
