using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim;

/// <content>Who takes part in an impact.</content>
public sealed partial class Simulation
{
    /// <summary>All contacts of this tick and round that share bodies with the first, found by following them.</summary>
    private void Gather(int slot, in EventKey key)
    {
        partyCount = 0;
        contactCount = 0;
        AddParty(slot);
        for (int i = 0; i < partyCount; i++)
        {
            int party = parties[i];
            for (int surface = 0; surface < Scene.PlaneArray.Length + Scene.SphereArray.Length; surface++)
            {
                if (TryTouchSurface(party, surface, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round)
                {
                    AddContact(new ContactPoint(i, ContactPoint.Static, surface, contact));
                }
            }

            foreach (int other in index.Candidates(party))
            {
                bool now = TryTouchBody(party, other, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
                if (now || (key.Round >= CollapseRound && IsTouching(party, other, key.Time, out contact)))
                {
                    int j = PartyOf(other);
                    if (j < 0 || j > i)
                    {
                        j = j < 0 ? AddParty(other) : j;
                        bool ordered = bodies[party].Id < bodies[other].Id != SwapsOperands;
                        AddContact(new ContactPoint(ordered ? i : j, ordered ? j : i, -1, contact));
                    }
                }
            }
        }
    }

    private bool IsTouching(int slot, int other, SimTime time, out ContactTime contact)
    {
        ContactTime.TryMake(time, time, 0, out contact);
        if (slot == other)
        {
            return false;
        }

        Vector3D apart = PositionAt(timelines.Last(slot), contact) - PositionAt(timelines.Last(other), contact);
        return apart.Length - (bodies[slot].Spec.Radius + bodies[other].Spec.Radius) <= Scene.Resolution; // the sum is the same whoever asks
    }

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
            Array.Resize(ref partyAccelerations, size);
        }

        parties[partyCount] = slot;
        return partyCount++;
    }

    private void AddContact(in ContactPoint contact)
    {
        if (contactCount == contacts.Length)
        {
            Array.Resize(ref contacts, contactCount * 2);
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
            while (at > 0 && bodies[moving].Id < bodies[parties[at - 1]].Id)
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
        int byFirst = bodies[parties[a.First]].Id.CompareTo(bodies[parties[b.First]].Id);
        return byFirst != 0 ? byFirst
            : a.Second >= 0 && b.Second >= 0 ? bodies[parties[a.Second]].Id.CompareTo(bodies[parties[b.Second]].Id)
            : a.Second != b.Second ? a.Second.CompareTo(b.Second)
            : a.Surface.CompareTo(b.Surface);
    }
}
