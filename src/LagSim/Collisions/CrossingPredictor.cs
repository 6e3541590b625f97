using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>When a body's newest segment next crosses the boundary of a sensor, or that of a sensor it carries crosses a body.</summary>
/// <remarks>
/// A pure function of the segments of body and carrier, of what the body has crossed on them, and of which sensors it is inside of. A body
/// that is inside is only watched for the way out, and one that is outside for the way in. So the two alternate, whatever rounding does to
/// a place on the boundary.
/// </remarks>
internal class CrossingPredictor(
    Scene scene, SimTime start, BodyTable bodies, TimelineStore timelines, SegmentLookup view, CrossingLog log)
{
    /// <summary>The error of a place, relative to the summed terms: sixteen roundings of a double.</summary>
    private const double Rounding = 16.0 / (1L << 52);

    private readonly Sensor[] sensors = scene.SensorArray;
    private readonly Paths paths = new(timelines);

    /// <summary>Considers the next crossing of each sensor, and by each body of those that this one carries.</summary>
    internal void Consider(int slot, int last, ref NextEvent next)
    {
        BodyId id = bodies.Id(slot);
        for (int sensor = 0; sensor < sensors.Length; sensor++)
        {
            if (sensors[sensor].Carrier is not BodyId carrier)
            {
                if (TryFind(slot, last, TimelineStore.None, sensor, out SimTime tick, out uint round))
                {
                    next.Consider(KeyOf(slot, sensor, tick, round));
                }
            }
            else if (carrier == id)
            {
                ConsiderCarried(slot, last, sensor, ref next);
            }
            else if (bodies.SlotOf(carrier) is int other && other >= 0)
            {
                ConsiderMeeting(slot, last, other, sensor, isCarried: false, ref next);
            }
        }
    }

    /// <summary>Whether a sensor sees a body on a segment: whether their filters match.</summary>
    private protected virtual bool Sees(int sensor, int segment) =>
        (sensors[sensor].Filter.IsDefault && !timelines.Extras.HaveFilters) || sensors[sensor].Filter.CollidesWith(timelines.Extras.Filter(segment));

    /// <summary>From when on the next crossing is searched for after the last one on the segment.</summary>
    private protected virtual SimTime SearchedFrom(int crossing, in EventKey opened)
    {
        SimTime time = log.Key(crossing).Time;
        int before = log.PreviousSince(crossing, opened);
        return before != CrossingLog.None && log.Key(before).Time == time ? time + SimDuration.OneTick : time; // what is thinner than a tick
    }

    /// <summary>Considers every body's next crossing of a sensor that this one carries.</summary>
    private void ConsiderCarried(int slot, int last, int sensor, ref NextEvent next)
    {
        foreach (int other in bodies)
        {
            if (other != slot)
            {
                ConsiderMeeting(slot, last, other, sensor, isCarried: true, ref next);
            }
        }
    }

    /// <summary>
    /// Considers the next crossing of a carried sensor, with the newest segment of one of the two, the body and the carrier, and whichever
    /// of the other's is in force: its newest, unless it is ahead of the heal.
    /// </summary>
    private void ConsiderMeeting(int slot, int last, int other, int sensor, bool isCarried, ref NextEvent next)
    {
        if (!timelines.IsKnown(other) || timelines.Last(other) == TimelineStore.None)
        {
            return;
        }

        int body = isCarried ? other : slot;
        SimTime end = timelines.Segment(last).End;
        for (int piece = view.SegmentFrom(slot, other); piece != TimelineStore.None; piece = timelines.Next(piece))
        {
            int after = timelines.Next(piece);
            if (TryFind(body, isCarried ? piece : last, isCarried ? last : piece, sensor, out SimTime tick, out uint round))
            {
                EventKey key = KeyOf(body, sensor, tick, round);
                if (after == TimelineStore.None || EventKey.Compare(timelines.Key(after), key) > 0)
                {
                    if (next.Consider(key))
                    {
                        next.Partner = other;
                        next.Piece = piece;
                    }

                    return;
                }
            }

            if (after != TimelineStore.None && timelines.Key(after).Time > end)
            {
                return;
            }
        }
    }

    private EventKey KeyOf(int slot, int sensor, SimTime tick, uint round) =>
        new(tick, round, EventKind.Crossing, bodies.Id(slot), bodies.Id(slot), 0, (uint)sensor);

    /// <summary>The next crossing of a body on a segment of its path, and on one of the carrier's; of a sensor that stands still on none.</summary>
    private bool TryFind(int slot, int own, int carrier, int sensor, out SimTime tick, out uint round)
    {
        bool isInside = log.IsInside(slot, sensor);
        int later = carrier != TimelineStore.None && EventKey.Compare(timelines.Key(carrier), timelines.Key(own)) > 0 ? carrier : own;
        ref readonly EventKey opened = ref timelines.Key(later);
        tick = opened.Time;
        round = opened.Round + 1;
        bool isThere = timelines.Segment(own).IsPresent && (carrier == TimelineStore.None || timelines.Segment(carrier).IsPresent);
        int before = log.LastSince(slot, sensor, opened);
        if (!isThere || !Sees(sensor, own))
        {
            return isInside && before == CrossingLog.None; // what is gone has left, and so has what is seen no more
        }

        if (before == CrossingLog.None && IsOnTheOtherSide(slot, own, carrier, sensor, isInside, opened))
        {
            return true;
        }

        SimTime from = before == CrossingLog.None ? tick : SearchedFrom(before, opened);
        SimTime until = carrier == TimelineStore.None
            ? timelines.Segment(own).End : SimTime.Min(timelines.Segment(own).End, timelines.Segment(carrier).End);
        if (from > until || !TryCross(slot, own, carrier, sensor, isInside, from, until, out ContactTime contact))
        {
            return false;
        }

        tick = contact.Tick;
        round = Math.Max(paths.RoundAfter(own, tick), carrier == TimelineStore.None ? 0 : paths.RoundAfter(carrier, tick));
        round = before != CrossingLog.None && log.Key(before).Time == tick ? Math.Max(round, log.Key(before).Round + 1) : round;
        return true;
    }

    private bool TryCross(int slot, int own, int carrier, int sensor, bool isInside, SimTime from, SimTime until, out ContactTime contact)
    {
        ref readonly MotionSegment segment = ref timelines.Segment(own);
        ref readonly Sensor region = ref sensors[sensor];
        double grown = region.Growth(bodies.Spec(slot).Radius);
        if (region.Shape == SensorShape.Plane)
        {
            return isInside
                ? TimeOfImpact.WithPlane(segment, timelines.Dense(own), -grown, region.Behind, from, until, out contact)
                : TimeOfImpact.WithPlane(segment, timelines.Dense(own), grown, region.Front, from, until, out contact);
        }

        double reach = region.Radius + grown;
        contact = default;
        MotionSegment centre = carrier == TimelineStore.None
            ? MotionSegment.AtRest(start, region.Centre)
            : timelines.Segment(carrier).At(timelines.Segment(carrier).Position + region.Centre);
        DenseOutput dense = carrier == TimelineStore.None ? default : timelines.Dense(carrier);
        return reach > 0 && (isInside
            ? TimeOfImpact.OutOfSphere(segment, timelines.Dense(own), centre, dense, reach, from, until, out contact)
            : TimeOfImpact.WithSphere(segment, timelines.Dense(own), centre, dense, reach, from, until, out contact));
    }

    /// <summary>
    /// Whether a segment begins on the other side: the body or the sensor was put there, or it is off by more than rounding, as where it was
    /// moved when the segment was opened, or is seen only from now on.
    /// </summary>
    private bool IsOnTheOtherSide(int slot, int own, int carrier, int sensor, bool isInside, in EventKey opened)
    {
        ContactTime now = ContactTime.At(opened.Time);
        Vector3D position = paths.PositionAt(own, now);
        Vector3D centre = carrier == TimelineStore.None ? Vector3D.Zero : paths.PositionAt(carrier, now);
        double gap = sensors[sensor].Gap(carrier == TimelineStore.None ? position : position - centre, bodies.Spec(slot).Radius);
        if (isInside ? gap <= 0 : gap >= 0)
        {
            return false;
        }

        if (opened.Kind is EventKind.Start or EventKind.Spawn or EventKind.Teleport)
        {
            return true;
        }

        double speed = paths.VelocityAt(own, now).Length + (carrier == TimelineStore.None ? 0 : paths.VelocityAt(carrier, now).Length);
        double size = SizeOf(position) + SizeOf(centre) + sensors[sensor].Size + bodies.Spec(slot).Radius;
        return Math.Abs(gap) > (Rounding * size) + (2 * speed * TickConversion.SecondsPerTick);
    }

    private static double SizeOf(in Vector3D position) => Math.Abs(position.X) + Math.Abs(position.Y) + Math.Abs(position.Z);
}
