using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>Where bodies are on the segments of their timelines: pure functions of a segment and an instant.</summary>
internal readonly struct Paths(TimelineStore timelines)
{
    private readonly TimelineStore timelines = timelines;

    /// <summary>Whether a body is held on a segment.</summary>
    internal bool IsHeld(int segment) => timelines.Segment(segment).Law == MotionLaw.Held;

    /// <summary>Whether a body is a member of an island on a segment.</summary>
    internal bool IsMember(int segment) => timelines.Segment(segment).IsOfIsland;

    /// <summary>How long after the beginning of a segment's law an instant is.</summary>
    internal double SecondsInto(int segment, SimTime time) => time.SecondsSince(timelines.Segment(segment).Epoch);

    /// <summary>The state of a body so many seconds into a segment; absent on one on which it is not there.</summary>
    internal static BodyState StateOf(in MotionSegment segment, double seconds, in DenseOutput dense, in PeriodicBox box, in Spin spin,
        CollisionFilter filter) =>
        segment.IsPresent
            ? new BodyState(box.Wrap(segment.PositionAt(seconds, dense)), segment.VelocityAt(seconds, dense), segment.Law, spin.At(seconds), filter)
            : default;

    /// <summary>The state of a body on a segment at an instant.</summary>
    internal BodyState StateAt(int segment, SimTime time, in PeriodicBox box) =>
        StateOf(timelines.Segment(segment), SecondsInto(segment, time), timelines.Dense(segment), box, timelines.SpinOf(segment),
        timelines.Extras.Filter(segment));

    internal Vector3D PositionAt(int segment, SimTime time) =>
        timelines.Segment(segment).PositionAt(SecondsInto(segment, time), timelines.Dense(segment));

    internal Vector3D PositionAt(int segment, in ContactTime contact) =>
        timelines.Segment(segment).PositionAt(SecondsInto(segment, contact.Tick) + contact.Residual, timelines.Dense(segment));

    internal Vector3D VelocityAt(int segment, in ContactTime contact) =>
        timelines.Segment(segment).VelocityAt(SecondsInto(segment, contact.Tick) + contact.Residual, timelines.Dense(segment));

    internal Vector3D AccelerationAt(int segment, in ContactTime contact) =>
        timelines.Segment(segment).AccelerationAt(SecondsInto(segment, contact.Tick) + contact.Residual, timelines.Dense(segment));

    /// <summary>
    /// The round of what happens to a body on a segment at <paramref name="time"/>: what a tick's own event causes at it comes a round
    /// later.
    /// </summary>
    internal uint RoundAfter(int segment, SimTime time)
    {
        ref readonly EventKey opened = ref timelines.Key(segment);
        return opened.Time == time ? opened.Round + 1 : 0;
    }
}
