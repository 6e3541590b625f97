using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>When a body's newest segment next crosses the boundary of a sensor.</summary>
/// <remarks>
/// A pure function of the segment, of what the body has crossed on it, and of which sensors it is inside of. A body that is inside
/// is only watched for the way out, and one that is outside for the way in. So the two alternate, whatever rounding does to a place on the
/// boundary.
/// </remarks>
internal class CrossingPredictor(Scene scene, SimTime start, BodyTable bodies, TimelineStore timelines, CrossingLog log)
{
    /// <summary>The error of a place, relative to the summed terms: sixteen roundings of a double.</summary>
    private const double Rounding = 16.0 / (1L << 52);

    private readonly Sensor[] sensors = scene.SensorArray;
    private readonly Paths paths = new(timelines);

    /// <summary>Considers the next crossing of each sensor.</summary>
    internal void Consider(int slot, int last, ref NextEvent next)
    {
        BodyId id = bodies.Id(slot);
        for (int sensor = 0; sensor < sensors.Length; sensor++)
        {
            if (Sees(slot, sensor) && TryFind(slot, last, sensor, out SimTime tick, out uint round))
            {
                next.Consider(new EventKey(tick, round, EventKind.Crossing, id, id, 0, (uint)sensor));
            }
        }
    }

    /// <summary>Whether a sensor takes notice of a body: every sensor of every body.</summary>
    private protected virtual bool Sees(int slot, int sensor) => true;

    /// <summary>From when on the next crossing is searched for after the last one on the segment.</summary>
    private protected virtual SimTime SearchedFrom(int crossing, in EventKey opened)
    {
        SimTime time = log.Key(crossing).Time;
        int before = log.PreviousSince(crossing, opened);
        return before != CrossingLog.None && log.Key(before).Time == time ? time + SimDuration.OneTick : time; // what is thinner than a tick
    }

    private bool TryFind(int slot, int last, int sensor, out SimTime tick, out uint round)
    {
        ref readonly MotionSegment segment = ref timelines.Segment(last);
        ref readonly EventKey opened = ref timelines.Key(last);
        bool isInside = log.IsInside(slot, sensor);
        tick = opened.Time;
        round = opened.Round + 1;
        if (!segment.IsPresent)
        {
            return isInside; // what is gone has left
        }

        int before = log.LastSince(slot, sensor, opened);
        if (before == CrossingLog.None && IsOnTheOtherSide(slot, last, sensor, isInside))
        {
            return true;
        }

        SimTime from = before == CrossingLog.None ? tick : SearchedFrom(before, opened);
        if (from > segment.End || !TryCross(slot, last, sensor, isInside, from, out ContactTime contact))
        {
            return false;
        }

        tick = contact.Tick;
        round = paths.RoundAfter(last, tick);
        round = before != CrossingLog.None && log.Key(before).Time == tick ? Math.Max(round, log.Key(before).Round + 1) : round;
        return true;
    }

    private bool TryCross(int slot, int last, int sensor, bool isInside, SimTime from, out ContactTime contact)
    {
        ref readonly MotionSegment segment = ref timelines.Segment(last);
        ref readonly Sensor region = ref sensors[sensor];
        double grown = region.Growth(bodies.Spec(slot).Radius);
        if (region.Shape == SensorShape.Plane)
        {
            return isInside
                ? TimeOfImpact.WithPlane(segment, timelines.Dense(last), -grown, region.Behind, from, segment.End, out contact)
                : TimeOfImpact.WithPlane(segment, timelines.Dense(last), grown, region.Front, from, segment.End, out contact);
        }

        double reach = region.Radius + grown;
        contact = default;
        return reach > 0 && (isInside
            ? TimeOfImpact.OutOfSphere(segment, timelines.Dense(last), region.Centre, reach, from, segment.End, out contact)
            : TimeOfImpact.WithSphere(
                segment, timelines.Dense(last), MotionSegment.AtRest(start, region.Centre), default, reach, from, segment.End, out contact));
    }

    /// <summary>
    /// Whether a segment begins on the other side: the body was put there, or was moved by more than rounding when the segment was opened.
    /// </summary>
    private bool IsOnTheOtherSide(int slot, int last, int sensor, bool isInside)
    {
        ref readonly EventKey opened = ref timelines.Key(last);
        ContactTime now = ContactTime.At(opened.Time);
        Vector3D position = paths.PositionAt(last, now);
        double gap = sensors[sensor].Gap(position, bodies.Spec(slot).Radius);
        if (isInside ? gap <= 0 : gap >= 0)
        {
            return false;
        }

        if (opened.Kind is EventKind.Start or EventKind.Spawn or EventKind.Teleport)
        {
            return true;
        }

        double speed = paths.VelocityAt(last, now).Length;
        double size = Math.Abs(position.X) + Math.Abs(position.Y) + Math.Abs(position.Z) + sensors[sensor].Size + bodies.Spec(slot).Radius;
        return Math.Abs(gap) > (Rounding * size) + (2 * speed * TickConversion.SecondsPerTick);
    }
}
