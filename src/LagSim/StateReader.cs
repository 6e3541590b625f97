using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Reads the world at any instant that is kept: pure functions of the timelines, which change nothing.</summary>
internal sealed class StateReader(PeriodicBox box, BodyTable bodies, TimelineStore timelines, Progress progress)
{
    private readonly Paths paths = new(timelines);

    /// <summary>The state of a body so many seconds into a segment.</summary>
    internal static BodyState StateOf(in MotionSegment segment, double seconds, in DenseOutput dense, in PeriodicBox box, in Spin spin, CollisionFilter filter) =>
        segment.IsPresent
            ? new BodyState(box.Wrap(segment.PositionAt(seconds, dense)), segment.VelocityAt(seconds, dense), segment.Law, spin.At(seconds), filter)
            : default;

    /// <summary>A body's state; the default if it is not there.</summary>
    internal BodyState StateAt(int slot, SimTime time)
    {
        int at = slot < 0 ? TimelineStore.None : timelines.At(slot, time);
        return at == TimelineStore.None
            ? default
            : StateOf(timelines.Segment(at), paths.SecondsInto(at, time), timelines.Dense(at), box, timelines.SpinOf(at),
                timelines.Extras.Filter(at));
    }

    /// <summary>The hold on a body; false if no peer holds it.</summary>
    internal bool TryReadHold(int slot, SimTime time, out Hold hold)
    {
        int at = slot < 0 ? TimelineStore.None : timelines.At(slot, time);
        bool isHeld = at != TimelineStore.None && paths.IsHeld(at);
        hold = isHeld ? timelines.HoldOf(at) : default;
        return isHeld;
    }

    /// <summary>A hash of the bits and identities of every body that is there.</summary>
    internal ulong StateHash(SimTime time)
    {
        StableHash hash = default;
        hash.Add(time - progress.Start);
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

                if (!state.Filter.IsDefault)
                {
                    hash.Add(0xF117E4UL);
                    hash.Add(state.Filter.Packed);
                }

                if (state.Motion == MotionLaw.Held)
                {
                    hash.Add((ulong)timelines.HoldOf(timelines.At(slot, time)).Peer);
                }
            }
        }

        return hash.Value;
    }

    /// <summary>A hash of every event up to and including a time.</summary>
    internal ulong EventHash(SimTime time)
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

    /// <summary>
    /// The kept events of a body, from the one that began its motion at a time on, each with the state right after it.
    /// </summary>
    internal IReadOnlyList<TimelineEntry> Timeline(int slot, SimTime from)
    {
        List<TimelineEntry> entries = new();
        int at = slot < 0 ? TimelineStore.None : timelines.Last(slot);
        for (bool isBefore = false; at != TimelineStore.None && !isBefore; at = timelines.Previous(at))
        {
            if (timelines.IsNote(at))
            {
                continue;
            }

            ref readonly EventKey key = ref timelines.Key(at);
            BodyState state = StateOf(
                timelines.Segment(at), paths.SecondsInto(at, key.Time), timelines.Dense(at), box, timelines.SpinOf(at), timelines.Extras.Filter(at));
            entries.Add(new TimelineEntry(key, state));
            isBefore = key.Time <= from;
        }

        entries.Reverse();
        return entries;
    }

    /// <summary>Whether an event changed its body, as far as is known now.</summary>
    internal bool TookEffect(in ExternalEvent external)
    {
        int slot = bodies.SlotOf(external.Body);
        for (int at = slot < 0 ? TimelineStore.None : timelines.Last(slot); at != TimelineStore.None; at = timelines.Previous(at))
        {
            ref readonly EventKey key = ref timelines.Key(at);
            if (key.Kind == external.Kind && key.Peer == external.Peer && key.Sequence == external.Sequence)
            {
                return key.Time <= progress.SimulatedTo; // paths ahead of it are from before the current rollback
            }
        }

        return false;
    }

    /// <summary>The world after everything before a time.</summary>
    internal WorldSnapshot Snapshot(SimTime time)
    {
        SimTime last = time - SimDuration.OneTick;
        List<BodySnapshot> there = new();
        foreach (int slot in bodies)
        {
            int at = timelines.At(slot, last);
            if (at != TimelineStore.None && timelines.Segment(at).IsPresent)
            {
                bool isMember = paths.IsMember(at);
                there.Add(new BodySnapshot(
                    bodies.Id(slot), bodies.Spec(slot), timelines.Key(at), timelines.Segment(at), timelines.Dense(at), timelines.HoldOf(at), timelines.SpinOf(at),
                    isMember ? timelines.Carried.CentreOf(at) : default, isMember ? timelines.Carried.StillSince(at) : default, isMember ? timelines.Carried.CopyOf(at) : Array.Empty<PersistentContact>(),
                    timelines.Extras.Filter(at), bodies.Players(slot)));
            }
        }

        return new WorldSnapshot(progress.Start, time, EventHash(last), there.ToArray());
    }
}
