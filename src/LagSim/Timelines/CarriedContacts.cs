using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// The data that segments of island members carry from step to step, besides their paths: persistent contacts, and the instants of their
/// step.
/// </summary>
/// <remarks>By segment; allocates only once there is an island, and when more is carried than ever before. Not thread-safe.</remarks>
internal sealed class CarriedContacts
{
    private const int None = TimelineStore.None;

    private Member[] members = Array.Empty<Member>(); // by segment; only once there is an island
    private PersistentContact[] contacts = Array.Empty<PersistentContact>(); // lists, linked
    private int[] nextContact = Array.Empty<int>();
    private int freeContact = None;
    private int usedContacts;

    /// <summary>The instant of which a member's velocity is: the middle of its contact step.</summary>
    internal SimTime CentreOf(int segment) => members[segment].Centre;

    /// <summary>Since when a member has not moved.</summary>
    internal SimTime StillSince(int segment) => members[segment].Still;

    /// <summary>The first contact that a member's segment carries, or <see cref="None"/>.</summary>
    internal int First(int segment) => members[segment].First;

    internal int Next(int contact) => nextContact[contact];

    /// <summary>How many of the contacts that a member's segment carries are with bodies.</summary>
    internal int BodiesOf(int segment) => members[segment].Bodies;

    internal ref readonly PersistentContact At(int contact) => ref contacts[contact];

    /// <summary>The contact of a member's segment with a body, or <see cref="None"/>.</summary>
    /// <remarks>
    /// It looks on from behind the one that it found last, since whoever asks goes through bodies in their order, as the list does.
    /// </remarks>
    internal int With(int segment, BodyId partner)
    {
        ref Member member = ref members[segment];
        int begin = member.Found == None ? None : nextContact[member.Found];
        int found = Find(begin, None, partner);
        found = found == None ? Find(member.First, begin, partner) : found;
        member.Found = found == None ? member.Found : found;
        return found;
    }

    private int Find(int from, int end, BodyId partner)
    {
        int at = from;
        while (at != end && (contacts[at].Surface != PersistentContact.NoSurface || contacts[at].Partner != partner))
        {
            at = nextContact[at];
        }

        return at == end ? None : at;
    }

    /// <summary>The contact of a member's segment with a static surface, or <see cref="None"/>.</summary>
    internal int With(int segment, int surface)
    {
        int at = First(segment);
        while (at != None && contacts[at].Surface != surface)
        {
            at = nextContact[at];
        }

        return at;
    }

    /// <summary>A copy of the contacts that a segment carries.</summary>
    internal PersistentContact[] CopyOf(int segment)
    {
        int count = 0;
        for (int at = members[segment].First; at != None; at = nextContact[at])
        {
            count++;
        }

        PersistentContact[] copy = count == 0 ? Array.Empty<PersistentContact>() : new PersistentContact[count];
        for (int at = members[segment].First, n = 0; at != None; at = nextContact[at])
        {
            copy[n++] = contacts[at];
        }

        return copy;
    }

    /// <summary>Begins what a member's segment, just appended, carries.</summary>
    /// <param name="segment">The segment.</param>
    /// <param name="centre">See <see cref="CentreOf"/>.</param>
    /// <param name="still">See <see cref="StillSince"/>.</param>
    /// <param name="room">The number of segments that there is room for.</param>
    internal void Begin(int segment, SimTime centre, SimTime still, int room)
    {
        if (segment >= members.Length)
        {
            Array.Resize(ref members, room);
        }

        members[segment] = new Member { Centre = centre, Still = still, First = None, Last = None, Found = None };
    }

    /// <summary>Adds a contact to the list of the segment begun.</summary>
    internal void Add(int segment, in PersistentContact contact)
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
        member.Bodies += contact.Surface == PersistentContact.NoSurface ? 1 : 0;
    }

    /// <summary>Whether a contact of the segment begun holds.</summary>
    internal void Hold(int contact, bool holds)
    {
        ref PersistentContact c = ref contacts[contact];
        c = new PersistentContact(c.Partner, c.Surface, holds, c.Push, c.Turn);
    }

    /// <summary>A contact of the segment begun, with a surface that holds, is solved.</summary>
    internal void Solve(int contact)
    {
        ref PersistentContact c = ref contacts[contact];
        c = new PersistentContact(c.Partner, c.Surface, holds: true, c.Push, c.Turn, solved: true);
    }

    /// <summary>Makes room for as many segments as the store has, if any carries something.</summary>
    internal void Grow(int room)
    {
        if (members.Length > 0)
        {
            Array.Resize(ref members, room);
        }
    }

    /// <summary>A member's segment is gone.</summary>
    internal void Release(int segment)
    {
        if (members[segment].Last != None)
        {
            nextContact[members[segment].Last] = freeContact;
            freeContact = members[segment].First;
            members[segment].First = None;
            members[segment].Last = None;
            members[segment].Found = None;
        }
    }

    /// <summary>Adds to a hash what a segment carries.</summary>
    internal void AddTo(ref StableHash hash, int segment, SimTime origin)
    {
        hash.Add(members[segment].Centre - origin);
        hash.Add(members[segment].Still - origin);
        for (int at = members[segment].First; at != None; at = nextContact[at])
        {
            hash.Add(contacts[at].Partner.Packed);
            hash.Add(((ulong)(uint)contacts[at].Surface << 1) | (contacts[at].Holds ? 1UL : 0) | (contacts[at].Solved ? 1UL << 33 : 0));
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
        internal int Found;
        internal int Bodies;
    }
}
