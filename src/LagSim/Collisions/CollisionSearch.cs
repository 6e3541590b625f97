using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>
/// Finds the next contact among candidates: for a body in free flight from the packed flight data, for any other by testing every
/// candidate.
/// </summary>
internal class CollisionSearch(
    BodyTable bodies, TimelineStore timelines, FreeFlights flights, StaticSurfaces surfaces, CollisionPredictor predictor,
    SegmentLookup view, StepMarks stepMarks, EventWork work)
{
    private readonly CollisionFilters filters = new(timelines.Extras, surfaces);

    /// <summary>
    /// The next contact of a body in free flight. The packed flights show which other bodies come near at all, and from when on. So only
    /// those that may be first are tested, as a rule one. The result is that of <see cref="FindAlong"/>, to the bit.
    /// </summary>
    internal virtual void FindInFlight(int slot, Span<int> candidates, SimTime from, SimTime until, ref NextEvent next)
    {
        work.CountCandidates(candidates.Length);
        bool isOnly = candidates.Length == 1 && candidates[0] == slot;
        Span<Approach> approaches = isOnly ? default : flights.Approaches(slot, candidates, from, next.Horizon(from, until));
        int count = approaches.Length;
        while (count > 0)
        {
            int first = 0;
            for (int i = 1; i < count && approaches[first].Seconds > 0; i++)
            {
                first = approaches[i].Seconds < approaches[first].Seconds ? i : first;
            }

            SimTime horizon = next.Horizon(from, until);
            if (FreeFlights.IsLater(approaches[first].Seconds, from, horizon))
            {
                break;
            }

            int other = approaches[first].Slot;
            bool isClose = approaches[first].Seconds == 0;
            approaches[first] = approaches[--count];
            ConsiderFlights(slot, other, isClose, horizon, ref next);
        }

        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            if (!surfaces.IsPlane(surface) || !flights.Misses(slot, surfaces.Plane(surface), from, next.Horizon(from, until)))
            {
                ConsiderSurface(slot, surface, ref next);
            }
        }
    }

    /// <summary>The next contact of a body on any path, and with any body that may be ahead of the heal.</summary>
    internal void FindAlong(int slot, Span<int> candidates, SimTime from, SimTime until, ref NextEvent next)
    {
        work.CountCandidates(candidates.Length);
        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            ConsiderSurface(slot, surface, ref next);
        }

        bool isOfStep = stepMarks.Has(slot);
        SimTime end = SimTime.Min(until, timelines.Segment(timelines.Last(slot)).End);
        foreach (int other in candidates)
        {
            if (!timelines.IsKnown(other) || (isOfStep && stepMarks.Has(other)))
            {
                continue;
            }

            int piece = view.SegmentFrom(slot, other);
            SimTime horizon = SimTime.Max(from, next.Horizon(from, end));
            if (piece != timelines.Last(other) || !flights.AreApart(slot, other, from, horizon))
            {
                ConsiderMeeting(slot, other, piece, horizon, ref next);
            }
        }
    }

    private void ConsiderSurface(int slot, int surface, ref NextEvent next)
    {
        if (predictor.TryTouchSurface(slot, surface, out ContactTime contact, out uint round))
        {
            BodyId id = bodies.Id(slot);
            if (next.Consider(new EventKey(contact.Tick, round, EventKind.Impact, id, id, 0, 0)))
            {
                next.Surface = surface;
                next.Residual = contact.Residual;
            }
        }
    }

    /// <summary>
    /// The next contact until some time with another body's path, from a segment on: with the first that is touched before it ended.
    /// </summary>
    private void ConsiderMeeting(int slot, int other, int piece, SimTime until, ref NextEvent next)
    {
        int after;
        do
        {
            after = timelines.Next(piece);
            SimTime end = after == TimelineStore.None ? until : SimTime.Min(until, timelines.Key(after).Time);
            if (!StayApart(slot, other, piece, end)
                && predictor.TryTouchBody(slot, other, piece, out ContactTime contact, out uint round)
                && (after == TimelineStore.None || EventKey.Compare(timelines.Key(after), EventKey.BeforeImpacts(contact.Tick, round)) >= 0))
            {
                ConsiderContact(slot, other, piece, contact, round, ref next);
                return;
            }

            piece = after;
        }
        while (after != TimelineStore.None && timelines.Key(after).Time <= until);
    }

    /// <summary>Whether a contact need not be looked for; it only saves time.</summary>
    private protected virtual bool StayApart(int slot, int other, int piece, SimTime until) => predictor.StayApart(slot, other, piece, until);

    /// <summary>
    /// The same for a body in free flight, without reading the segments unless the two touch as soon as both paths are open.
    /// </summary>
    private void ConsiderFlights(int slot, int other, bool isClose, SimTime until, ref NextEvent next)
    {
        if (!timelines.IsKnown(other))
        {
            return;
        }

        int newest = timelines.Last(other);
        if (flights.IsFree(other) && !filters.Meet(timelines.Last(slot), newest))
        {
            return;
        }

        bool ordered = bodies.Id(slot) < bodies.Id(other);
        if (!flights.IsFree(other) || !flights.TryTouch(ordered ? slot : other, ordered ? other : slot, out bool touches, out ContactTime contact))
        {
            ConsiderMeeting(slot, other, newest, until, ref next);
        }
        else if (touches)
        {
            ConsiderContact(slot, other, newest, contact, 0, ref next);
        }
        else if (isClose && flights.AreSunk(slot, other))
        {
            ConsiderMeeting(slot, other, newest, until, ref next);
        }
    }

    private void ConsiderContact(int slot, int other, int piece, in ContactTime contact, uint round, ref NextEvent next)
    {
        BodyId id = bodies.Id(slot);
        BodyId otherId = bodies.Id(other);
        bool ordered = id < otherId;
        if (next.Consider(new EventKey(contact.Tick, round, EventKind.Impact, ordered ? id : otherId, ordered ? otherId : id, 0, 0)))
        {
            next.Partner = other;
            next.Piece = piece;
            next.Residual = contact.Residual;
        }
    }
}
