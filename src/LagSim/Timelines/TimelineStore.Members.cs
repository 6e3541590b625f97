using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <content>What the segments of members of islands carry besides their paths.</content>
internal sealed partial class TimelineStore
{
    private Member[] members = Array.Empty<Member>(); // by segment; only once there is an island
    private LastingContact[] contacts = Array.Empty<LastingContact>(); // lists, linked
    private int[] nextContact = Array.Empty<int>();
    private int freeContact = None;
    private int usedContacts;

    /// <summary>The instant of which a member's velocity is: the middle of its contact step.</summary>
    internal SimTime CentreOf(int segment) => members[segment].Centre;

    /// <summary>Since when a member has not moved.</summary>
    internal SimTime StillSince(int segment) => members[segment].Still;

    /// <summary>The first contact that a member's segment carries, or <see cref="None"/>.</summary>
    internal int FirstContact(int segment) => members[segment].First;

    internal int NextContact(int contact) => nextContact[contact];

    internal ref readonly LastingContact Contact(int contact) => ref contacts[contact];

    /// <summary>The contact of a member's segment with a body, or <see cref="None"/>.</summary>
    internal int ContactWith(int segment, BodyId partner)
    {
        int at = FirstContact(segment);
        while (at != None && (contacts[at].Surface != LastingContact.NoSurface || contacts[at].Partner != partner))
        {
            at = nextContact[at];
        }

        return at;
    }

    /// <summary>The contact of a member's segment with a static surface, or <see cref="None"/>.</summary>
    internal int ContactWith(int segment, int surface)
    {
        int at = FirstContact(segment);
        while (at != None && contacts[at].Surface != surface)
        {
            at = nextContact[at];
        }

        return at;
    }

    /// <summary>A copy of the contacts that a segment carries.</summary>
    internal LastingContact[] ContactsOf(int segment)
    {
        if (!pieces[segment].Segment.IsOfIsland)
        {
            return Array.Empty<LastingContact>();
        }

        int count = 0;
        for (int at = members[segment].First; at != None; at = nextContact[at])
        {
            count++;
        }

        LastingContact[] copy = count == 0 ? Array.Empty<LastingContact>() : new LastingContact[count];
        for (int at = members[segment].First, n = 0; at != None; at = nextContact[at])
        {
            copy[n++] = contacts[at];
        }

        return copy;
    }

    /// <summary>Begins what a member's segment, just appended, carries.</summary>
    internal void BeginMember(int segment, SimTime centre, SimTime still)
    {
        if (segment >= members.Length)
        {
            Array.Resize(ref members, pieces.Length);
        }

        members[segment] = new Member { Centre = centre, Still = still, First = None, Last = None };
    }

    /// <summary>Adds a contact to the list of the segment begun.</summary>
    internal void AddContact(int segment, in LastingContact contact)
    {
        int at = freeContact;
        if (at != None)
        {
            freeContact = nextContact[at];
        }
        else
        {
            at = usedContacts++;
            if (at == contacts.Length)
            {
                int size = Math.Max(64, contacts.Length + (contacts.Length / 2));
                Array.Resize(ref contacts, size);
                Array.Resize(ref nextContact, size);
            }
        }

        contacts[at] = contact;
        nextContact[at] = None;
        ref Member member = ref members[segment];
        if (member.Last == None)
        {
            member.First = at;
        }
        else
        {
            nextContact[member.Last] = at;
        }

        member.Last = at;
    }

    /// <summary>Whether a contact of the segment begun holds.</summary>
    internal void Hold(int contact, bool holds)
    {
        ref LastingContact c = ref contacts[contact];
        c = new LastingContact(c.Partner, c.Surface, holds, c.Push, c.Turn);
    }

    /// <summary>Ends it: from here on it counts in the hash.</summary>
    internal void EndMember(int segment, BodyId body) => hashes.Value += HashOf(segment, body);

    private void ReleaseContacts(int segment)
    {
        if (pieces[segment].Segment.IsOfIsland && members[segment].Last != None)
        {
            nextContact[members[segment].Last] = freeContact;
            freeContact = members[segment].First;
            members[segment].First = None;
            members[segment].Last = None;
        }
    }

    private void AddMember(ref StableHash hash, int segment)
    {
        hash.Add(members[segment].Centre - origin);
        hash.Add(members[segment].Still - origin);
        for (int at = members[segment].First; at != None; at = nextContact[at])
        {
            hash.Add(contacts[at].Partner.Packed);
            hash.Add(((ulong)(uint)contacts[at].Surface << 1) | (contacts[at].Holds ? 1UL : 0));
            hash.Add(contacts[at].Push);
            hash.Add(contacts[at].Turn);
        }
    }

    /// <summary>Of a member's segment.</summary>
    private struct Member
    {
        internal SimTime Centre;
        internal SimTime Still;
        internal int First;
        internal int Last;
    }
}
