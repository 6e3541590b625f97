using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Members of islands between two ticks: what they look for no impacts with, how one goes on after something has happened to it, who wakes.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// Whether a contact that a member's piece carries is the step's affair and no impact's: a surface that the step took into account, or an impact by a hand, which may
    /// press no further, or that the member does not close on. What a step's solver leaves is an error of the step, which the next goes on from.
    /// </summary>
    private bool IsCovered(int slot, int piece, int surface)
    {
        int at = timelines.ContactWith(piece, surface);
        if (at == TimelineStore.None)
        {
            return false;
        }

        ref readonly MotionSegment path = ref timelines.Segment(piece);
        return timelines.Key(piece).Kind == EventKind.StepEnd || (IsSolved(slot, piece, at) && IsOpenedWithHand(piece))
            || (timelines.Contact(at).Holds && Vector3D.Dot(surfaces.Normal(surface, path.Position), path.Velocity) >= -step.Scale.ImpactSpeed);
    }

    /// <summary>Whether the impact that opened a piece solved a contact that it carries: one that holds, but for an elastic one, which impacts do not go on over.</summary>
    private bool IsSolved(int slot, int piece, int contact) =>
        timelines.Key(piece).Kind == EventKind.Impact && timelines.Contact(contact).Holds && !IsElastic(slot, timelines.Contact(contact));

    /// <summary>
    /// Whether the impact that opened a member's piece was one with a hand that the member touches. A world that began from a snapshot may
    /// know the hand's path only from a later piece on; then that one tells.
    /// </summary>
    private bool IsOpenedWithHand(int piece)
    {
        bool isByHand = false;
        for (int at = timelines.FirstContact(piece); at != TimelineStore.None && !isByHand; at = timelines.NextContact(at))
        {
            ref readonly LastingContact contact = ref timelines.Contact(at);
            int partner = contact.Surface == LastingContact.NoSurface ? bodies.SlotOf(contact.Partner) : NoPartner;
            isByHand = partner >= 0 && IsOpenedWith(partner, timelines.Key(piece));
        }

        return isByHand;
    }

    private bool IsOpenedWith(int hand, in EventKey key)
    {
        int before = PieceBefore(hand, key);
        int opened = before == TimelineStore.None ? timelines.First(hand) : timelines.Next(before);
        return opened != TimelineStore.None && paths.IsHeld(opened) && (before == TimelineStore.None || timelines.Key(opened) == key);
    }

    /// <summary>Whether a member is surely further from a surface than it gets on its chord.</summary>
    private bool IsOutOfReach(int slot, in MotionSegment chord, int surface)
    {
        double gap = surfaces.Gap(surface, chord.Position, bodies.Spec(slot).Radius);
        double way = chord.End.SecondsSince(chord.Epoch) * 1.001;
        return gap > 0 && gap * gap > chord.Velocity.LengthSquared * way * way + (step.Scale.Length * step.Scale.Length * 1e-6);
    }

    /// <summary>The same of two bodies: pieces of one step or impact, or such that do not close where the later one begins.</summary>
    private bool IsCovered(int slot, int piece, int other, int otherPiece)
    {
        if (paths.IsHeld(otherPiece))
        {
            (slot, piece, other, otherPiece) = (other, otherPiece, slot, piece);
        }

        if (paths.IsHeld(piece) && paths.IsMember(otherPiece))
        {
            return IsCoveredFromHand(slot, piece, otherPiece);
        }

        if (!paths.IsMember(piece) || !paths.IsMember(otherPiece))
        {
            return false;
        }

        int at = timelines.ContactWith(piece, bodies.Id(other));
        if (at == TimelineStore.None || timelines.ContactWith(otherPiece, bodies.Id(slot)) == TimelineStore.None)
        {
            return false;
        }

        if (timelines.Key(piece) == timelines.Key(otherPiece) && (timelines.Key(piece).Kind == EventKind.StepEnd || IsSolved(slot, piece, at)))
        {
            return true;
        }

        SimTime opened = SimTime.Max(timelines.Key(piece).Time, timelines.Key(otherPiece).Time);
        Vector3D normal = (paths.PositionAt(piece, opened) - paths.PositionAt(otherPiece, opened)).Direction;
        double opening = Vector3D.Dot(normal, timelines.Segment(piece).Velocity - timelines.Segment(otherPiece).Velocity);
        return timelines.Contact(at).Holds && opening >= -step.Scale.ImpactSpeed;
    }

    /// <summary>The same of a hand, which may speed up, and a member: neither where the later piece begins nor where the step ends do they close.</summary>
    private bool IsCoveredFromHand(int hand, int handPiece, int piece)
    {
        int at = timelines.ContactWith(piece, bodies.Id(hand));
        if (at == TimelineStore.None || !timelines.Contact(at).Holds)
        {
            return false;
        }

        if (timelines.Key(piece) == timelines.Key(handPiece))
        {
            return true;
        }

        SimTime opened = SimTime.Max(timelines.Key(piece).Time, timelines.Key(handPiece).Time);
        SimTime end = SimTime.Min(timelines.Segment(piece).End, timelines.Segment(handPiece).End);
        return end >= opened && OpeningAt(handPiece, piece, opened) >= -step.Scale.ImpactSpeed && OpeningAt(handPiece, piece, end) >= -step.Scale.ImpactSpeed;
    }

    private bool Holds(int piece, int surface)
    {
        int at = timelines.ContactWith(piece, surface);
        return at != TimelineStore.None && timelines.Contact(at).Holds;
    }

    /// <summary>Whether two bodies, of which one may be a hand's, carry a contact that holds them together.</summary>
    private bool HoldTogether(int slot, int piece, int other, int otherPiece)
    {
        bool isMember = paths.IsMember(piece);
        if (!isMember && !paths.IsMember(otherPiece))
        {
            return false;
        }

        int at = isMember ? timelines.ContactWith(piece, bodies.Id(other)) : timelines.ContactWith(otherPiece, bodies.Id(slot));
        return at != TimelineStore.None && timelines.Contact(at).Holds;
    }

    private double OpeningAt(int piece, int otherPiece, SimTime time)
    {
        Vector3D velocity = timelines.Segment(piece).VelocityAt(paths.SecondsInto(piece, time), timelines.Dense(piece))
            - timelines.Segment(otherPiece).VelocityAt(paths.SecondsInto(otherPiece, time), timelines.Dense(otherPiece));
        return Vector3D.Dot((paths.PositionAt(piece, time) - paths.PositionAt(otherPiece, time)).Direction, velocity);
    }

    /// <summary>Opens the next piece of a member from a state: a chord to the end of the step under way, or of one that begins if it slept.</summary>
    private void GoOnAsMember(int slot, in EventKey key, in Vector3D position, in Vector3D velocity, in Vector3D spin, bool hasChanged)
    {
        int before = timelines.Last(slot);
        MotionSegment path = timelines.Segment(before);
        bool slept = path.Law == MotionLaw.Resting;
        SimTime centre = slept ? key.Time : timelines.CentreOf(before);
        SimTime still = slept || hasChanged ? key.Time : timelines.StillSince(before);
        if (slept && !hasChanged)
        {
            centre = timelines.CentreOf(before);
            still = timelines.StillSince(before);
            timelines.Append(slot, bodies.Id(slot), key, MotionSegment.AtRest(key.Time, path.Position), default, spin: timelines.SpinOf(before));
        }
        else
        {
            OpenChord(slot, key, slept ? NextTick(slot, key.Time, StepWanted(slot, position, velocity, spin)) : path.End, position, velocity, spin);
        }

        int piece = timelines.Last(slot);
        timelines.BeginMember(piece, centre, still);
        for (int at = timelines.FirstContact(before); at != TimelineStore.None; at = timelines.NextContact(at))
        {
            LastingContact contact = timelines.Contact(at);
            timelines.AddContact(piece, contact);
        }
    }

    /// <summary>When the first step of a body begins that becomes a member: at this instant if it is a tick, but for one that a step has let go at it.</summary>
    private SimTime NextTick(int slot, SimTime time, double wanted)
    {
        ref readonly EventKey opened = ref timelines.Key(timelines.Last(slot));
        bool hadIt = opened.Kind == EventKind.StepEnd && opened.Time == time;
        return step.Scale.TickFrom(hadIt ? time + SimDuration.OneTick : time, wanted);
    }

    /// <summary>The parties: those that sleep in contact with a body to which something is about to happen; false if one was ahead of it and has been taken back.</summary>
    private bool TryFindSleepers(int slot, in EventKey key)
    {
        partyCount = 0;
        contactCount = 0;
        int last = timelines.Last(slot);
        if (last == TimelineStore.None || !paths.IsMember(last))
        {
            return true;
        }

        ahead.Clear();
        for (int at = timelines.FirstContact(last); at != TimelineStore.None; at = timelines.NextContact(at))
        {
            ref readonly LastingContact contact = ref timelines.Contact(at);
            int partner = contact.Surface == LastingContact.NoSurface ? bodies.SlotOf(contact.Partner) : NoPartner;
            int piece = partner < 0 ? TimelineStore.None : PieceBefore(partner, key);
            if (piece != TimelineStore.None && paths.IsMember(piece) && timelines.Segment(piece).Law == MotionLaw.Resting)
            {
                if (piece != timelines.Last(partner))
                {
                    ahead.Add(partner);
                }

                AddParty(partner);
            }
        }

        if (ahead.Count > 0)
        {
            TakeBackAhead(key);
            return false;
        }

        SortParties();
        return true;
    }

    /// <summary>The parties wake: what they lay on has been touched.</summary>
    private void WakeParties(int slot, in EventKey key)
    {
        for (int i = 0; i < partyCount; i++)
        {
            int before = timelines.Last(parties[i]);
            GoOnAsMember(parties[i], key, timelines.Segment(before).Position, Vector3D.Zero, timelines.SpinOf(before).AtEpoch, hasChanged: true);
            timelines.EndMember(timelines.Last(parties[i]), bodies.Id(parties[i]));
        }

        AddParty(slot);
        timelines.Join(parties.AsSpan(0, partyCount));
        partyCount--;
        for (int i = 0; i < partyCount; i++)
        {
            Predict(parties[i]);
        }
    }
}
