using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Reads the world at any instant that is kept: pure functions of the timelines, which change nothing.</summary>
internal sealed class StateReader(PeriodicBox box, BodyTable bodies, TimelineStore timelines, Progress progress, RuleLog? rules)
{
    private readonly Paths paths = new(timelines);

    /// <summary>The crossings of sensors; null in a scene without.</summary>
    internal CrossingLog? Crossings { get; set; }

    /// <summary>A body's state; the default if it is not there.</summary>
    internal BodyState StateAt(int slot, SimTime time)
    {
        int at = slot < 0 ? TimelineStore.None : timelines.At(slot, time);
        return at == TimelineStore.None ? default : paths.StateAt(at, time, box);
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

                for (int sensor = 0; sensor < (Crossings?.SensorCount ?? 0); sensor++)
                {
                    if (Crossings!.IsInside(slot, sensor, time))
                    {
                        hash.Add((ulong)(uint)sensor | (1UL << 63));
                    }
                }

                if (state.Motion == MotionLaw.Held)
                {
                    hash.Add((ulong)timelines.HoldOf(timelines.At(slot, time)).Peer);
                }
            }
        }

        if (rules is not null)
        {
            StateLayout.AddTo(ref hash, rules.StateAt(time).Bytes);
        }

        return hash.Value;
    }

    /// <summary>A hash of every event up to and including a time.</summary>
    internal ulong EventHash(SimTime time)
    {
        ulong sum = timelines.EventHash + (Crossings?.EventHash ?? 0) + (rules?.EventHash(time) ?? 0);
        foreach (int slot in bodies)
        {
            sum -= Crossings?.HashAfter(slot, time) ?? 0;
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
            entries.Add(new TimelineEntry(key, paths.StateAt(at, key.Time, box)));
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
                    timelines.Extras.Filter(at), InsideOf(slot, last), CrossingsOf(slot, timelines.Key(at), last), bodies.Players(slot)));
            }
        }

        return new WorldSnapshot(progress.Start, time, EventHash(last), there.ToArray(), rules is null ? Array.Empty<byte>() : rules.StateAt(last).Bytes.ToArray());
    }

    /// <summary>Whether a body is inside of a sensor after everything of a time.</summary>
    internal bool IsInside(int slot, int sensor, SimTime time) => slot >= 0 && Crossings is not null && Crossings.IsInside(slot, sensor, time);

    /// <summary>The crossings of all bodies from one time to another, both included, in canonical order.</summary>
    internal IReadOnlyList<Crossing> CrossingsIn(SimTime from, SimTime to)
    {
        List<Crossing> found = new();
        if (Crossings is null)
        {
            return found;
        }

        foreach (int slot in bodies)
        {
            for (int at = Crossings.Last(slot); at != CrossingLog.None && Crossings.Key(at).Time >= from; at = Crossings.Previous(at))
            {
                if (Crossings.Key(at).Time <= to)
                {
                    found.Add(Crossings.At(at));
                }
            }
        }

        found.Sort(static (a, b) => EventKey.Compare(a.Key, b.Key));
        return found;
    }

    /// <summary>The sensors that a body is inside of, by ascending index.</summary>
    private int[] InsideOf(int slot, SimTime time)
    {
        if (Crossings is null)
        {
            return Array.Empty<int>();
        }

        List<int> inside = new();
        for (int sensor = 0; sensor < Crossings.SensorCount; sensor++)
        {
            if (Crossings.IsInside(slot, sensor, time))
            {
                inside.Add(sensor);
            }
        }

        return inside.ToArray();
    }

    /// <summary>What a body has crossed from a key up to and including a time, in canonical order.</summary>
    private Crossing[] CrossingsOf(int slot, in EventKey since, SimTime time)
    {
        if (Crossings is null)
        {
            return Array.Empty<Crossing>();
        }

        List<Crossing> found = new();
        for (int at = Crossings.Last(slot); at != CrossingLog.None && EventKey.Compare(Crossings.Key(at), since) >= 0; at = Crossings.Previous(at))
        {
            if (Crossings.Key(at).Time <= time)
            {
                found.Add(Crossings.At(at));
            }
        }

        found.Reverse();
        return found.ToArray();
    }
}
