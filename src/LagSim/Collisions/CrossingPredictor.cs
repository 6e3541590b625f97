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
                if (TryFind(slot, last, SensorPath.Fixed(timelines), sensor, out SimTime tick, out uint round))
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
        (sensors[sensor].Filter.IsDefault && !timelines.Extras.HaveFilters)
        || sensors[sensor].Filter.CollidesWith(timelines.Extras.Filter(segment));

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
        if (!timelines.IsKnown(other))
        {
            return;
        }

        int body = isCarried ? other : slot;
        SimTime end = timelines.Segment(last).End;
        for (int piece = view.SegmentFrom(slot, other); piece != TimelineStore.None; piece = timelines.Next(piece))
        {
            int after = timelines.Next(piece);
            SensorPath path = SensorPath.On(timelines, isCarried ? last : piece);
            if (TryFind(body, isCarried ? piece : last, path, sensor, out SimTime tick, out uint round))
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

    /// <summary>The next crossing of a body on a segment of its path, by a sensor that moves so.</summary>
    private bool TryFind(int slot, int segment, in SensorPath path, int sensor, out SimTime tick, out uint round)
    {
        bool isInside = log.IsInside(slot, sensor);
        EventKey opened = path.OpenedWith(segment);
        tick = opened.Time;
        round = opened.Round + 1;
        int before = log.LastSince(slot, sensor, opened);
        if (!timelines.Segment(segment).IsPresent || !path.IsPresent || !Sees(sensor, segment))
        {
            return isInside && before == CrossingLog.None; // what is gone has left, and so has what is seen no more
        }

        if (before == CrossingLog.None && IsOnTheOtherSide(slot, segment, path, sensor, isInside, opened))
        {
            return true;
        }

        SimTime from = before == CrossingLog.None ? tick : SearchedFrom(before, opened);
        SimTime until = SimTime.Min(timelines.Segment(segment).End, path.End);
        if (from > until || !TryCross(slot, segment, path, sensor, isInside, from, until, out ContactTime contact))
        {
            return false;
        }

        tick = contact.Tick;
        round = Math.Max(paths.RoundAfter(segment, tick), path.RoundAfter(tick));
        round = before != CrossingLog.None && log.Key(before).Time == tick ? Math.Max(round, log.Key(before).Round + 1) : round;
        return true;
    }

    private bool TryCross(
        int slot, int segment, in SensorPath path, int sensor, bool isInside, SimTime from, SimTime until, out ContactTime contact)
    {
        ref readonly MotionSegment motion = ref timelines.Segment(segment);
        DenseOutput dense = timelines.Dense(segment);
        ref readonly Sensor region = ref sensors[sensor];
        double grown = region.Growth(bodies.Spec(slot).Radius);
        if (region.Shape == SensorShape.Plane)
        {
            return isInside
                ? TimeOfImpact.WithPlane(motion, dense, -grown, region.Behind, from, until, out contact)
                : TimeOfImpact.WithPlane(motion, dense, grown, region.Front, from, until, out contact);
        }

        double reach = region.Radius + grown;
        contact = default;
        MotionSegment centre = path.CentreOf(region, start, out DenseOutput denseCentre);
        return reach > 0 && (isInside
            ? TimeOfImpact.OutOfSphere(motion, dense, centre, denseCentre, reach, from, until, out contact)
            : TimeOfImpact.WithSphere(motion, dense, centre, denseCentre, reach, from, until, out contact));
    }

    /// <summary>
    /// Whether a segment begins on the other side: the body or the sensor was put there, or it is off by more than rounding, as where it
    /// was moved when the segment was opened, or is seen only from now on.
    /// </summary>
    private bool IsOnTheOtherSide(int slot, int segment, in SensorPath path, int sensor, bool isInside, in EventKey opened)
    {
        ContactTime now = ContactTime.At(opened.Time);
        Vector3D position = paths.PositionAt(segment, now);
        Vector3D origin = path.OriginAt(now);
        double radius = bodies.Spec(slot).Radius;
        double gap = sensors[sensor].Gap(position - origin, radius);
        if (isInside ? gap <= 0 : gap >= 0)
        {
            return false;
        }

        if (opened.Kind is EventKind.Start or EventKind.Spawn or EventKind.Teleport)
        {
            return true;
        }

        double speed = paths.VelocityAt(segment, now).Length + path.SpeedAt(now);
        double size = position.Taxicab + origin.Taxicab + sensors[sensor].Size + radius;
        return Math.Abs(gap) > (Rounding * size) + (2 * speed * TickConversion.SecondsPerTick);
    }
}
