using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Reading: pure functions of the timelines.</content>
public sealed partial class Simulation
{
    /// <summary>Where a body is at any instant from <see cref="HistoryEdge"/> to <see cref="Horizon"/>, after all events of that tick.</summary>
    /// <returns>False, and a state that is <see cref="MotionLaw.Absent"/>, if the body is unknown or not there at that time.</returns>
    /// <remarks>
    /// Opens no segment and changes nothing. Cost: the number of the body's segments after that time. A time that is not simulated is a mistake of the caller,
    /// who advances this world himself, and so an exception; a <see cref="Hosting.Picture"/>, which another thread makes, returns false there.
    /// </remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is before <see cref="HistoryEdge"/> or after <see cref="Horizon"/>: advance first.</exception>
    /// <exception cref="InvalidOperationException">The simulation ended by an exception.</exception>
    public bool TryRead(BodyId body, SimTime time, out BodyState state)
    {
        CheckReadable(time);
        int slot = bodies.SlotOf(body);
        if (slot < 0)
        {
            state = default;
            return false;
        }

        state = StateAt(slot, time);
        return state.Motion != MotionLaw.Absent;
    }

    /// <summary>Who holds a body at an instant that can be read, by which point, and when its hand last told where it is.</summary>
    /// <returns>False, and the default, if nobody does.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    public bool TryReadHold(BodyId body, SimTime time, out Hold hold)
    {
        CheckReadable(time);
        int slot = bodies.SlotOf(body);
        int at = slot < 0 ? TimelineStore.None : timelines.At(slot, time);
        bool isHeld = at != TimelineStore.None && paths.IsHeld(at);
        hold = isHeld ? timelines.HoldOf(at) : default;
        return isHeld;
    }

    /// <summary>A hash of the exact bits and identities of every body that is there at <paramref name="time"/>.</summary>
    /// <remarks>Equal on two peers if and, to 64 bits, only if their worlds are the same then. It does not depend on the time of day.</remarks>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    public ulong StateHash(SimTime time)
    {
        CheckReadable(time);
        StableHash hash = default;
        hash.Add(time - Start);
        foreach (int slot in bodies)
        {
            BodyState state = StateAt(slot, time);
            if (state.Motion != MotionLaw.Absent)
            {
                hash.Add(bodies.Id(slot).Packed);
                hash.Add((ulong)state.Motion);
                hash.Add(state.Position);
                hash.Add(state.Velocity);
                if (state.Spin != Vector3D.Zero)
                {
                    hash.Add(state.Spin);
                }

                if (state.Motion == MotionLaw.Held)
                {
                    hash.Add((ulong)timelines.HoldOf(timelines.At(slot, time)).Peer);
                }
            }
        }

        return hash.Value;
    }

    /// <summary>A hash of every event from the start up to and including <paramref name="time"/>, in canonical order, with what came of it.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The time is outside the window.</exception>
    public ulong EventHash(SimTime time)
    {
        CheckReadable(time);
        return EventHashUpTo(time);
    }

    private ulong EventHashUpTo(SimTime time)
    {
        ulong sum = timelines.EventHash;
        foreach (int slot in bodies)
        {
            for (int at = timelines.Last(slot); at != TimelineStore.None && timelines.Key(at).Time > time; at = timelines.Previous(at))
            {
                sum -= timelines.HashOf(at, bodies.Id(slot));
            }
        }

        return sum;
    }

    /// <summary>A body's events that are kept, in order, each with the state right after it. Empty for an unknown body.</summary>
    /// <remarks>For reports and tests; allocates. Cost: the number of the body's segments.</remarks>
    public IReadOnlyList<TimelineEntry> Timeline(BodyId body) => Timeline(body, SimTime.MinValue);

    /// <summary>Of a body's events that are kept the last one up to and including <paramref name="from"/>, whose motion it is in then, and all after it.</summary>
    /// <param name="body">The body. Of an unknown one there are none.</param>
    /// <param name="from">From when on, in simulated time; any instant, also one that is no longer kept or not simulated yet.</param>
    /// <returns>In order, each with the state right after it.</returns>
    /// <remarks>For reports that go along with the simulation; allocates. Cost: the number of the events returned, however long the history is.</remarks>
    public IReadOnlyList<TimelineEntry> Timeline(BodyId body, SimTime from)
    {
        List<TimelineEntry> entries = new();
        int slot = bodies.SlotOf(body);
        int at = slot < 0 ? TimelineStore.None : timelines.Last(slot);
        for (bool isBefore = false; at != TimelineStore.None && !isBefore; at = timelines.Previous(at))
        {
            if (timelines.IsNote(at))
            {
                continue;
            }

            MotionSegment segment = timelines.Segment(at);
            double seconds = paths.SecondsInto(at, timelines.Key(at).Time);
            entries.Add(new TimelineEntry(timelines.Key(at), StateOf(segment, seconds, timelines.Dense(at), Scene.Box, timelines.SpinOf(at))));
            isBefore = timelines.Key(at).Time <= from;
        }

        entries.Reverse();
        return entries;
    }

    /// <summary>
    /// Whether an event changed its body, as far as is known now. False while its time is not simulated yet; if it was submitted and its time has come, it had no
    /// effect: the body was not there, or was in a hand (or not in that hand), or an impulse would have made it faster than a body may be given to move, a tenth
    /// of <see cref="Scene.SmallestRadius"/> in a tick. Nothing is ever clamped. Later news may change the answer.
    /// </summary>
    /// <remarks>Pure, the same on every peer. Cost: the number of the body's segments. What lies before <see cref="HistoryEdge"/> is no longer known: false.</remarks>
    public bool TookEffect(in ExternalEvent external)
    {
        int slot = bodies.SlotOf(external.Body);
        for (int at = slot < 0 ? TimelineStore.None : timelines.Last(slot); at != TimelineStore.None; at = timelines.Previous(at))
        {
            ref readonly EventKey key = ref timelines.Key(at);
            if (key.Kind == external.Kind && key.Peer == external.Peer && key.Sequence == external.Sequence)
            {
                return key.Time <= SimulatedTo; // what stands ahead of it is of before the heal at hand
            }
        }

        return false;
    }

    /// <summary>The properties of a body that has been there; the default for an unknown one.</summary>
    public BodySpec SpecOf(BodyId body)
    {
        int slot = bodies.SlotOf(body);
        return slot < 0 ? default : bodies.Spec(slot);
    }

    /// <summary>
    /// Forgets what lies before <paramref name="time"/>: nothing there can be read or changed any more. Earlier than now is kept, later is not forgotten.
    /// </summary>
    public void DropHistoryBefore(SimTime time)
    {
        HistoryEdge = SimTime.Max(HistoryEdge, SimTime.Min(time, SimulatedTo));
        timelines.ForgetBefore(HistoryEdge);
        index.DropBefore(HistoryEdge);
        twin?.DropHistoryBefore(time);
    }

    internal TimelineStore Timelines => timelines;

    internal int SlotCount => bodies.SlotCount;

    /// <summary>Changes whenever a body is heard of or forgotten, so that a reader knows when to look at all of them anew.</summary>
    internal long OrderVersion => bodies.Version;

    internal int SlotAt(int n) => bodies.SlotAt(n);

    internal int SlotNamed(BodyId id) => bodies.SlotOf(id);

    internal BodyId IdOfSlot(int slot) => bodies.Id(slot);

    internal double RadiusOfSlot(int slot) => bodies.Spec(slot).Radius;

    internal static BodyState StateOf(in MotionSegment segment, double seconds, in DenseOutput dense, in PeriodicBox box, in Spin spin) =>
        segment.IsPresent
            ? new BodyState(box.Wrap(segment.PositionAt(seconds, dense)), segment.VelocityAt(seconds, dense), segment.Law, spin.At(seconds))
            : default;

    private BodyState StateAt(int slot, SimTime time)
    {
        int at = timelines.At(slot, time);
        return at == TimelineStore.None ? default : StateOf(timelines.Segment(at), paths.SecondsInto(at, time), timelines.Dense(at), Scene.Box, timelines.SpinOf(at));
    }

    private void CheckReadable(SimTime time)
    {
        ThrowIfFaulted();
        if (time < HistoryEdge || time > Horizon)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"Readable is from {HistoryEdge.ToShortString()}, the edge of the history, to {Horizon.ToShortString()},"
                    + " where the next event is due.");
        }
    }
}
