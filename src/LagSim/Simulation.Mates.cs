using System;
using System.Collections.Generic;
using LagSim.Contacts;
using LagSim.Events;

namespace LagSim;

/// <content>The bodies of one island: what happens to one of them happens to all.</content>
public sealed partial class Simulation
{
    /// <summary>A step of an island ends: all of it go on, together or apart, by their states there.</summary>
    private void HandleIslandStep(int slot, in EventKey key)
    {
        FindMates(slot, withSelf: true);
        OpenMates(key, mayRest: true);
        timelines.Join(parties.AsSpan(0, partyCount));
        PredictParties();
    }

    /// <summary>
    /// Something has opened a new piece for one of an island, which is now the newest of that slot: the others, who are the parties at hand, go on without it.
    /// </summary>
    private void ReleaseMates(int slot, in EventKey key)
    {
        OpenMates(key, mayRest: false);
        AddParty(slot);
        timelines.Join(parties.AsSpan(0, partyCount));
        partyCount--;
        PredictParties();
    }

    /// <summary>Makes the parties at hand of those in an island with a body, with it or without.</summary>
    private void FindMates(int slot, bool withSelf)
    {
        partyCount = 0;
        contactCount = 0;
        int last = timelines.Last(slot);
        if (withSelf)
        {
            AddParty(slot);
        }

        for (int mate = timelines.Mate(last); mate != last; mate = timelines.Mate(mate))
        {
            AddParty(timelines.Owner(mate));
        }

        SortParties();
    }

    /// <summary>Opens the next pieces of the parties at hand, from where they are on their newest ones.</summary>
    private void OpenMates(in EventKey key, bool mayRest)
    {
        EvaluateParties(key.Time, 0);
        OpenIslands(key, 0, mayRest);
        for (int i = 0; i < partyCount; i++)
        {
            if (!isOpened[i])
            {
                int count = 0;
                for (int k = 0; k < touchingCount; k++)
                {
                    ref readonly ContactPoint c = ref touching[k];
                    if (c.First == i && c.Second == ContactPoint.Static && IsSupportable(c))
                    {
                        AddTouched(ref count, c.Surface);
                    }
                }

                Open(parties[i], key, partyPositions[i], partyVelocities[i], 0, touched.AsSpan(0, count), 0, partySpins[i]);
            }
        }

        JoinIslands(parties, partyCount);
    }

    private void PredictParties()
    {
        for (int i = 0; i < partyCount; i++)
        {
            Predict(parties[i]);
        }
    }

    /// <summary>Puts the newest pieces of these bodies, which one event opened, into their islands: a pure function of the pieces.</summary>
    private void JoinIslands(int[] slots, int count)
    {
        for (int i = 0; i < count; i++)
        {
            int piece = timelines.Last(slots[i]);
            for (int j = 0; j < i && timelines.Segment(piece).IsOfIsland; j++)
            {
                int other = timelines.Last(slots[j]);
                if (Lasts(slots[i], piece, slots[j], other))
                {
                    timelines.JoinIslands(piece, other);
                }
            }
        }
    }

    /// <summary>Puts all bodies into their islands: those whose newest pieces one event opened, and that touch there.</summary>
    private void JoinIslands()
    {
        List<int> members = new();
        for (int slot = 0; slot < slotCount; slot++)
        {
            if (timelines.Segment(timelines.Last(slot)).IsOfIsland)
            {
                members.Add(slot);
            }
        }

        members.Sort((a, b) => EventKey.Compare(timelines.Key(timelines.Last(a)), timelines.Key(timelines.Last(b))));
        int[] together = new int[members.Count];
        for (int from = 0; from < members.Count;)
        {
            EventKey key = timelines.Key(timelines.Last(members[from]));
            int count = 0;
            for (; from < members.Count && timelines.Key(timelines.Last(members[from])) == key; from++)
            {
                together[count++] = members[from];
            }

            JoinIslands(together, count);
        }
    }
}
