using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>The world as rules see it: after the event of their call, and before any that comes later in the canonical order.</summary>
/// <remarks>Pure functions of the timelines. While a heal is under way some bodies are known beyond that event; what they do later is not
/// seen.</remarks>
internal sealed class RuleView(Scene scene, BodyTable bodies, TimelineStore timelines)
{
    private readonly Paths paths = new(timelines);

    /// <summary>Reads a body, as it is right after an event.</summary>
    internal RuleRead ReadBody(BodyId body, in EventKey after)
    {
        RuleRead read = new() { Body = body, Radius = -1 };
        int slot = bodies.SlotOf(body);
        int at = slot < 0 ? TimelineStore.None : timelines.Before(slot, after.JustAfter);
        if (at != TimelineStore.None && timelines.Segment(at).IsPresent)
        {
            read.State = paths.StateAt(at, after.Time, scene.Box);
            read.Hold = timelines.HoldOf(at);
            read.Spec = bodies.Spec(slot);
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
                && (scene.Box.Wrap(paths.PositionAt(at, after.Time)) - centre).LengthSquared <= radius * radius)
            {
                reads.Add(new RuleRead { Body = bodies.Id(slot) });
            }
        }

        reads[region] = new RuleRead { Radius = radius, Centre = centre, Count = reads.Count - region - 1 };
    }

    /// <summary>Whether a call would read again what it read.</summary>
    /// <param name="reads">What it read.</param>
    /// <param name="after">The event that the call is for.</param>
    /// <param name="spare">Room to read again.</param>
    internal bool IsUnchanged(List<RuleRead> reads, in EventKey after, List<RuleRead> spare)
    {
        for (int n = 0; n < reads.Count; n++)
        {
            if (reads[n].Radius < 0)
            {
                RuleRead now = ReadBody(reads[n].Body, after);
                if (!IsSame(reads[n], now))
                {
                    return false;
                }

                continue;
            }

            spare.Clear();
            ReadRegion(reads[n].Centre, reads[n].Radius, after, spare);
            bool isSame = spare[0].Count == reads[n].Count;
            for (int found = 1; found <= reads[n].Count && isSame; found++)
            {
                isSame = spare[found].Body == reads[n + found].Body;
            }

            if (!isSame)
            {
                return false;
            }

            n += reads[n].Count;
        }

        return true;
    }

    private static bool IsSame(in RuleRead a, in RuleRead b) =>
        a.State.Motion == b.State.Motion && a.State.Filter == b.State.Filter && IsSame(a.State.Position, b.State.Position) && IsSame(a.State.Velocity, b.State.Velocity)
        && IsSame(a.State.Spin, b.State.Spin) && a.Hold == b.Hold && a.Spec.Equals(b.Spec);

    private static bool IsSame(in Vector3D a, in Vector3D b) =>
        BitConverter.DoubleToInt64Bits(a.X) == BitConverter.DoubleToInt64Bits(b.X)
        && BitConverter.DoubleToInt64Bits(a.Y) == BitConverter.DoubleToInt64Bits(b.Y)
        && BitConverter.DoubleToInt64Bits(a.Z) == BitConverter.DoubleToInt64Bits(b.Z);
}
