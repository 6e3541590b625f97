using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>The world as rules see it: after the event of their call, and before any that comes later in the canonical order.</summary>
/// <remarks>Pure functions of the timelines. While a heal is under way some bodies are known beyond that event; what they do later is not
/// seen.</remarks>
/// <param name="scene">The scene.</param>
/// <param name="bodies">The bodies.</param>
/// <param name="timelines">Their paths.</param>
/// <param name="crossings">Which sensors they crossed; null in a scene without sensors.</param>
internal sealed class RuleView(Scene scene, BodyTable bodies, TimelineStore timelines, CrossingLog? crossings)
{
    private readonly Paths paths = new(timelines);
    private readonly Clearance clearance = new(scene);

    /// <summary>What lies before this can no longer change.</summary>
    internal SimTime HistoryEdge => timelines.Edge;

    /// <summary>Reads a body, as it is right after an event. Of one that has gone with that very event its properties are still known.</summary>
    internal RuleRead ReadBody(BodyId body, in EventKey after)
    {
        RuleRead read = new() { Kind = RuleReadKind.Body, Body = body };
        int slot = bodies.SlotOf(body);
        int at = slot < 0 ? TimelineStore.None : timelines.Before(slot, after.JustAfter);
        if (at != TimelineStore.None && timelines.Segment(at).IsPresent)
        {
            read.State = paths.StateAt(at, after.Time, scene.Box);
            read.Hold = timelines.HoldOf(at);
            read.Spec = bodies.Spec(slot);
        }
        else if (slot >= 0 && after.Body == body && after.Kind is EventKind.Remove or EventKind.Lost)
        {
            read.Spec = bodies.Spec(slot); // it has just gone: what it was made of is known here for the last time
        }

        return read;
    }

    /// <summary>Reads which bodies have their centres within a sphere, in order of identity.</summary>
    /// <param name="centre">Its centre, in metres.</param>
    /// <param name="radius">Its radius in metres.</param>
    /// <param name="after">The event after which they are there.</param>
    /// <param name="reads">Gets the region, and after it the bodies.</param>
    internal void ReadRegion(in Vector3D centre, double radius, in EventKey after, List<RuleRead> reads)
    {
        int region = reads.Count;
        reads.Add(default);
        foreach (int slot in bodies)
        {
            int at = timelines.Before(slot, after.JustAfter);
            if (at != TimelineStore.None && timelines.Segment(at).IsPresent
                && scene.Box.Nearest(paths.PositionAt(at, after.Time) - centre).LengthSquared <= radius * radius)
            {
                reads.Add(new RuleRead { Body = bodies.Id(slot) });
            }
        }

        reads[region] = new RuleRead { Kind = RuleReadKind.Region, Radius = radius, Centre = centre, Count = reads.Count - region - 1 };
    }

    /// <summary>Reads whether a body is inside of a sensor, after all crossings up to an event, that included.</summary>
    internal RuleRead ReadSensor(BodyId body, int sensor, in EventKey after)
    {
        int slot = bodies.SlotOf(body);
        bool isInside = slot >= 0 && crossings is not null && crossings.IsInside(slot, sensor, after);
        return new RuleRead { Kind = RuleReadKind.Sensor, Body = body, Sensor = sensor, IsInside = isInside };
    }

    /// <summary>Reads whether there is room for a body: whether its place is inside of no body and no static geometry that it collides
    /// with.</summary>
    /// <param name="spec">The body's properties, with its filter.</param>
    /// <param name="centre">The place of its centre, in metres.</param>
    /// <param name="leftOut">The body itself, which is not in its own way; null for one that is not there yet.</param>
    /// <param name="after">The event after which there is room.</param>
    internal RuleRead ReadRoom(in BodySpec spec, in Vector3D centre, BodyId? leftOut, in EventKey after)
    {
        bool hasRoom = clearance.Admits(centre, spec, spec.Filter);
        foreach (int slot in bodies)
        {
            if (!hasRoom)
            {
                break;
            }

            int at = bodies.Id(slot) == leftOut ? TimelineStore.None : timelines.Before(slot, after.JustAfter);
            if (at != TimelineStore.None && timelines.Segment(at).IsPresent && spec.Filter.CollidesWith(timelines.Extras.Filter(at)))
            {
                Vector3D there = scene.Box.Wrap(paths.PositionAt(at, after.Time));
                hasRoom = clearance.AreApart(centre, there, spec.Radius + bodies.Spec(slot).Radius);
            }
        }

        return new RuleRead
        {
            Kind = RuleReadKind.Room,
            Spec = spec,
            Centre = centre,
            Body = leftOut ?? default,
            LeavesOut = leftOut is not null,
            HasRoom = hasRoom,
        };
    }

    /// <summary>Whether a call would read again what it read.</summary>
    /// <param name="reads">What it read.</param>
    /// <param name="after">The event that the call is for.</param>
    /// <param name="spare">Room to read again.</param>
    internal bool IsUnchanged(List<RuleRead> reads, in EventKey after, List<RuleRead> spare)
    {
        for (int n = 0; n < reads.Count; n++)
        {
            bool isSame = reads[n].Kind switch
            {
                RuleReadKind.Body => IsSame(reads[n], ReadBody(reads[n].Body, after)),
                RuleReadKind.Room => IsSameRoom(reads[n], after),
                RuleReadKind.Sensor => reads[n].IsInside == ReadSensor(reads[n].Body, reads[n].Sensor, after).IsInside,
                _ => IsSameRegion(reads, n, after, spare),
            };
            if (!isSame)
            {
                return false;
            }

            n += reads[n].Count;
        }

        return true;
    }

    private bool IsSameRoom(in RuleRead read, in EventKey after) =>
        read.HasRoom == ReadRoom(read.Spec, read.Centre, read.LeavesOut ? read.Body : null, after).HasRoom;

    private bool IsSameRegion(List<RuleRead> reads, int region, in EventKey after, List<RuleRead> spare)
    {
        spare.Clear();
        ReadRegion(reads[region].Centre, reads[region].Radius, after, spare);
        bool isSame = spare[0].Count == reads[region].Count;
        for (int found = 1; found <= reads[region].Count && isSame; found++)
        {
            isSame = spare[found].Body == reads[region + found].Body;
        }

        return isSame;
    }

    private static bool IsSame(in RuleRead a, in RuleRead b) =>
        a.State.Motion == b.State.Motion && a.State.Filter == b.State.Filter && IsSame(a.State.Position, b.State.Position) && IsSame(a.State.Velocity, b.State.Velocity)
        && IsSame(a.State.Spin, b.State.Spin) && a.Hold == b.Hold && a.Spec.Equals(b.Spec);

    private static bool IsSame(in Vector3D a, in Vector3D b) =>
        BitConverter.DoubleToInt64Bits(a.X) == BitConverter.DoubleToInt64Bits(b.X)
        && BitConverter.DoubleToInt64Bits(a.Y) == BitConverter.DoubleToInt64Bits(b.Y)
        && BitConverter.DoubleToInt64Bits(a.Z) == BitConverter.DoubleToInt64Bits(b.Z);
}
