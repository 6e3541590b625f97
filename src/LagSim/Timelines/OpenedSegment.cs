using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim.Timelines;

/// <summary>A segment and the key that opened it.</summary>
internal struct OpenedSegment
{
    internal MotionSegment Segment;
    internal EventKey Key;

    /// <summary>
    /// Whether it only notes that an event looked at a body which is gone: for heals, which cut the event with it. A peer that joined later
    /// has no such body, so it is in no hash and in no list of events.
    /// </summary>
    internal readonly bool IsNote => !Segment.IsPresent && Segment.Loss == LossReason.None && Key.Kind is (EventKind.Impact or EventKind.StepEnd);

    /// <summary>Whether an event opened it: none did where a body is first known by a late event, and is not there yet.</summary>
    internal readonly bool IsEvent => Key.Kind != EventKind.None && !IsNote;
}
