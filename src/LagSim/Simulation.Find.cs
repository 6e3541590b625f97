using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Finding the next contact among candidates: of a body in free flight from what is side by side, of any other by a look at everybody.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// The next contact of a body in free flight. From the flights it is seen which of the others come near at all, and from when on; so only those are looked
    /// at that may be the first, and that is one as a rule. It finds what <see cref="FindAlong"/> finds, to the bit.
    /// </summary>
    private void FindInFlight(int slot, Span<int> candidates, SimTime from, SimTime until, int except, ref Pending next)
    {
        bool isOnly = candidates.Length == 1 && candidates[0] == slot;
        Span<Approach> approaches = isOnly ? default : flights.Approaches(slot, candidates, from, next.Horizon(from, until));
        int count = approaches.Length;
        while (count > 0)
        {
            int first = 0;
            for (int i = 1; i < count; i++)
            {
                first = approaches[i].Seconds < approaches[first].Seconds ? i : first;
            }

            if (FreeFlights.IsLater(approaches[first].Seconds, from, next.Horizon(from, until)))
            {
                break;
            }

            int other = approaches[first].Slot;
            approaches[first] = approaches[--count];
            if (other != except)
            {
                ConsiderFlights(slot, other, until, ref next);
            }
        }

        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            if (!surfaces.IsPlane(surface) || !flights.Misses(slot, surfaces.Plane(surface), from, next.Horizon(from, until)))
            {
                ConsiderSurface(slot, surface, ref next);
            }
        }
    }

    /// <summary>The next contact of a body on any path, and with anybody who may be ahead of what is being healed.</summary>
    private void FindAlong(int slot, Span<int> candidates, SimTime from, SimTime until, int except, ref Pending next)
    {
        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            ConsiderSurface(slot, surface, ref next);
        }

        bool isOfStep = IsOfStep(slot) && !TakesNoShortcut;
        SimTime end = SimTime.Min(until, timelines.Segment(timelines.Last(slot)).End);
        foreach (int other in candidates)
        {
            if (other != except && !(isOfStep && IsOfStep(other))
                && !flights.AreApart(slot, other, from, SimTime.Max(from, next.Horizon(from, end))))
            {
                ConsiderMeeting(slot, other, until, ref next);
            }
        }
    }

    private void ConsiderSurface(int slot, int surface, ref Pending next)
    {
        if (TryTouchSurface(slot, surface, out ContactTime contact, out uint round))
        {
            BodyId id = bodies.Id(slot);
            if (next.Consider(new EventKey(contact.Tick, round, EventKind.Impact, id, id, 0, 0)))
            {
                next.Surface = surface;
                next.Residual = contact.Residual;
            }
        }
    }

    private void ConsiderMeeting(int slot, int other, SimTime until, ref Pending next)
    {
        if (timelines.IsKnown(other) && TryMeet(slot, other, until, out int piece, out ContactTime contact, out uint round))
        {
            ConsiderContact(slot, other, piece, contact, round, ref next);
        }
    }

    /// <summary>The same of one in free flight, without a look at the segments unless the two touch as soon as both paths are open.</summary>
    private void ConsiderFlights(int slot, int other, SimTime until, ref Pending next)
    {
        bool ordered = bodies.Id(slot) < bodies.Id(other);
        if (!flights.IsFree(other) || !flights.TryTouch(ordered ? slot : other, ordered ? other : slot, out bool touches, out ContactTime contact))
        {
            ConsiderMeeting(slot, other, until, ref next);
        }
        else if (touches)
        {
            ConsiderContact(slot, other, timelines.Last(other), contact, 0, ref next);
        }
    }

    private void ConsiderContact(int slot, int other, int piece, in ContactTime contact, uint round, ref Pending next)
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

    /// <summary>The least of what has been considered, and whom it is with.</summary>
    private struct Pending
    {
        internal bool Any;
        internal EventKey Key;
        internal int Partner;
        internal int Surface;
        internal int Piece;
        internal double Residual;
        internal bool IsTied; // something else was considered at that tick

        /// <summary>
        /// Up to when contacts may come before what was considered: those that come soon may be at once (<see cref="ContactTime.IsSoonAfter"/>).
        /// </summary>
        internal readonly SimTime Horizon(SimTime from, SimTime until) =>
            Any ? SimTime.Min(until, SimTime.Max(Key.Time, from + ContactTime.Soon)) : until;

        internal bool Consider(in EventKey key)
        {
            IsTied = Any && (key.Time == Key.Time || (key.Time > Key.Time && IsTied));
            if (Any && EventKey.Compare(key, Key) >= 0)
            {
                return false;
            }

            Any = true;
            Key = key;
            Partner = NoPartner;
            return true;
        }
    }
}
