using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>One event of a body and what came of it.</summary>
/// <remarks>Immutable.</remarks>
public readonly struct TimelineEntry
{
    internal TimelineEntry(EventKey key, BodyState state)
    {
        Key = key;
        State = state;
    }

    /// <summary>The event that opened this segment.</summary>
    public EventKey Key { get; }

    /// <summary>The body right after it.</summary>
    public BodyState State { get; }
}
