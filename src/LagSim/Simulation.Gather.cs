using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Who takes part in an impact.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// All contacts of this tick and round that share bodies with the first, and the bodies as they meet, in canonical order. Returns the
    /// seconds from the tick to the impact. Contacts that were struck in this instant already are among them if one of those is struck again.
    /// </summary>
    private double Gather(int slot, in EventKey key, out bool collapses)
    {
        bool mayCollapse = hasLosses && MayBeStruckAgain(key) && !NeverCollapses;
        Follow(slot, key, mayCollapse);
        collapses = mayCollapse && ahead.Count == 0 && Collapses(key.Time);
        if (mayCollapse && ahead.Count == 0 && !collapses)
        {
            Follow(slot, key, withStruckBefore: false);
        }

        if (ahead.Count > 0)
        {
            return 0;
        }

        // One instant for all: the earliest root. The others are met within a tick, so nothing is yet deep in anything.
        double residual = double.MaxValue;
        for (int i = 0; i < contactCount; i++)
        {
            residual = !contacts[i].IsFromBefore ? Math.Min(residual, contacts[i].Time.Residual) : residual;
        }

        EvaluateParties(key.Time, residual);
        return residual;
    }

    /// <summary>
    /// Finds contacts from body to body: those that are struck and, if asked to, those that were struck earlier in this instant and still touch.
    /// It finds the same contacts whichever of the bodies it begins at, so two impacts of one round have no body in common. Bodies that merely
    /// touch are left out, because a heal would not know that they were looked at.
    /// </summary>
    private void Follow(int slot, in EventKey key, bool withStruckBefore)
    {
        partyCount = 0;
        contactCount = 0;
        ahead.Clear();
        AddParty(slot);
        for (int i = 0; i < partyCount && ahead.Count == 0; i++)
        {
            int party = parties[i];
            for (int surface = 0; surface < surfaces.Count; surface++)
            {
                bool isStruck = predictor.TryTouchSurface(party, surface, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
                if (isStruck || (withStruckBefore && IsStillTouching(party, surface, key.Time, out contact)))
                {
                    AddContact(new ContactPoint(i, ContactPoint.Static, surface, contact) { IsFromBefore = !isStruck });
                }
            }

            foreach (int other in index.CandidatesAt(party, bodies.Spec(party).Radius, key.Time, HealAtHand != 0))
            {
                if (other == party || !timelines.IsKnown(other) || flights.AreApart(party, other, key.Time, key.Time))
                {
                    continue;
                }

                int then = view.PieceAt(other, key);
                if (then == TimelineStore.None)
                {
                    continue;
                }

                bool isStruck = predictor.TryTouchBody(party, other, then, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
                if (isStruck || (withStruckBefore && paths.RoundAfter(then, key.Time) <= key.Round
                    && AreStillTouching(party, other, then, key.Time, out contact)))
                {
                    if (then != timelines.Last(other))
                    {
                        ahead.Add(other);
                        continue;
                    }

                    int j = PartyOf(other);
                    if (j < 0 || j > i)
                    {
                        j = j < 0 ? AddParty(other) : j;
                        bool ordered = bodies.Id(party) < bodies.Id(other) != SwapsOperands;
                        AddContact(new ContactPoint(ordered ? i : j, ordered ? j : i, -1, contact) { IsFromBefore = !isStruck });
                    }
                }
            }
        }

        SortParties();
        SortContacts();
    }

    /// <summary>The distance between two bodies' surfaces at a tick, on these pieces of their paths; the same bits whoever asks.</summary>
    private double Gap(int slot, int piece, int other, int otherPiece, SimTime time) =>
        Scene.Box.Nearest(paths.PositionAt(piece, time) - paths.PositionAt(otherPiece, time)).Length - (bodies.Spec(slot).Radius + bodies.Spec(other).Radius);

    private int PartyOf(int slot) => Array.IndexOf(parties, slot, 0, partyCount);

    private int AddParty(int slot)
    {
        if (partyCount == parties.Length)
        {
            int size = partyCount * 2;
            Array.Resize(ref parties, size);
            Array.Resize(ref partyMasses, size);
            Array.Resize(ref partyPositions, size);
            Array.Resize(ref partyVelocities, size);
            Array.Resize(ref isReached, size);
            Array.Resize(ref partySpins, size);
            Array.Resize(ref partyRadii, size);
            Array.Resize(ref partyAccelerations, size);
        }

        parties[partyCount] = slot;
        return partyCount++;
    }

    private void AddContact(in ContactPoint contact)
    {
        if (contactCount == contacts.Length)
        {
            Array.Resize(ref contacts, Math.Max(8, contactCount * 2));
        }

        contacts[contactCount++] = contact;
    }

    /// <summary>Parties by identity: whose slot came first, and who found whom, leaves no trace in any sum over them.</summary>
    private void SortParties()
    {
        // While the parties move, contacts name them by slot.
        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.First = parties[c.First];
            c.Second = c.Second == ContactPoint.Static ? c.Second : parties[c.Second];
        }

        for (int i = 1; i < partyCount; i++)
        {
            int moving = parties[i];
            int at = i;
            while (at > 0 && bodies.Id(moving) < bodies.Id(parties[at - 1]))
            {
                parties[at] = parties[at - 1];
                at--;
            }

            parties[at] = moving;
        }

        for (int i = 0; i < contactCount; i++)
        {
            ref ContactPoint c = ref contacts[i];
            c.First = PartyOf(c.First);
            c.Second = c.Second == ContactPoint.Static ? c.Second : PartyOf(c.Second);
        }
    }

    /// <summary>Canonical order, by identities and then surface, so that the way they were found leaves no trace in a sum.</summary>
    private void SortContacts()
    {
        for (int i = 1; i < contactCount; i++)
        {
            ContactPoint moving = contacts[i];
            int at = i;
            while (at > 0 && Compare(moving, contacts[at - 1]) < 0)
            {
                contacts[at] = contacts[at - 1];
                at--;
            }

            contacts[at] = moving;
        }
    }

    private int Compare(in ContactPoint a, in ContactPoint b)
    {
        int byFirst = bodies.Id(parties[a.First]).CompareTo(bodies.Id(parties[b.First]));
        return byFirst != 0 ? byFirst
            : a.Second >= 0 && b.Second >= 0 ? bodies.Id(parties[a.Second]).CompareTo(bodies.Id(parties[b.Second]))
            : a.Second != b.Second ? a.Second.CompareTo(b.Second)
            : a.Surface.CompareTo(b.Surface);
    }
}
