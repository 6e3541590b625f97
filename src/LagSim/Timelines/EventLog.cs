using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>The external events of every body inside the window, in canonical order, so that a rolled-back body meets them again.</summary>
/// <remarks>
/// Each body's events are a list in their order, and a tree by which one is found, added or removed in a time of log n. All of them whose effect
/// depends on where other bodies are have a tree besides.
/// </remarks>
internal sealed class EventLog
{
    internal const int None = EventOrder.None;

    private const int FirstRoom = 16;

    private readonly EventOrder order = new();
    private Entry[] entries = Array.Empty<Entry>();
    private int used;
    private int free = None;
    private Body[] bodies; // by slot
    private EventOrder? placings; // made with the first event whose effect depends on where other bodies are
    private int placingRoot = None;

    /// <summary>No events yet; with room for as many bodies as are expected at first.</summary>
    internal EventLog(int expected = 0) => bodies = new Body[expected];

    /// <summary>Makes room for a body's events.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= bodies.Length)
        {
            Array.Resize(ref bodies, Math.Max(slot + 1, Math.Max(16, bodies.Length * 2)));
        }

        bodies[slot] = new Body { Root = None, First = None, Last = None, Due = None };
    }

    /// <summary>The body's first event that is not applied yet, or is to be applied again; <see cref="None"/> if there is none.</summary>
    internal int Due(int slot) => bodies[slot].Due;

    /// <summary>Takes the event that is due: the one after it is due now.</summary>
    internal int TakeDue(int slot)
    {
        int taken = bodies[slot].Due;
        bodies[slot].Due = entries[taken].Next;
        return taken;
    }

    /// <summary>The body's events from the key on are due, and none before it.</summary>
    internal void SetDueFrom(int slot, in EventKey key) => bodies[slot].Due = FirstFrom(slot, key);

    /// <summary>The body's events from the key on are due, also again; those before it that are still due stay so.</summary>
    internal void AddDueFrom(int slot, in EventKey key)
    {
        int from = FirstFrom(slot, key);
        if (from != None && (bodies[slot].Due == None || EventKey.Compare(order.Key(from), order.Key(bodies[slot].Due)) < 0))
        {
            bodies[slot].Due = from;
        }
    }

    internal ref readonly ExternalEvent Event(int entry) => ref entries[entry].Event;

    /// <summary>Where in the order it takes effect: its own key, or the arrival where a strategy applies it late.</summary>
    internal ref readonly EventKey Key(int entry) => ref order.Key(entry);

    /// <summary>Whether it is applied by advancing the body alone from the event's stamp to the key's time.</summary>
    internal bool IsForwarded(int entry) => entries[entry].Forwarded;

    /// <summary>
    /// The first event after a key whose effect depends on where other bodies are when it comes, or <see cref="None"/>; and its body.
    /// </summary>
    internal int PlacingAfter(in EventKey key, out int slot)
    {
        int found = placings is null ? None : placings.FirstAfter(placingRoot, key);
        slot = found == None ? -1 : entries[found].Slot;
        return found;
    }

    internal int Next(int entry) => entries[entry].Next;

    /// <summary>Adds an event; false if the body has one of that key, which is then the same event received again.</summary>
    internal bool TryAdd(int slot, in ExternalEvent external, in EventKey key, bool forwarded)
    {
        int before = LastBefore(slot, key);
        int after = before == None ? bodies[slot].First : entries[before].Next;
        if (after != None && order.Key(after) == key)
        {
            return false;
        }

        int at = free;
        if (at != None)
        {
            free = entries[at].Next;
        }
        else
        {
            at = used++;
            if (at == entries.Length)
            {
                Array.Resize(ref entries, Math.Max(FirstRoom, at * 2));
            }
        }

        entries[at] = new Entry { Event = external, Slot = slot, Forwarded = forwarded };
        Link(slot, before, at);
        Link(slot, at, after);
        order.Add(ref bodies[slot].Root, at, key);
        if (external.WhenOccupied != WhenOccupied.Overlap)
        {
            placings ??= new EventOrder();
            placings.Add(ref placingRoot, at, key);
        }

        return true;
    }

    /// <summary>Removes an event of a body, known by its peer and sequence; false if it is not there.</summary>
    internal bool TryRemove(int slot, in ExternalEvent external, out EventKey key)
    {
        int at = FirstFrom(slot, external.Key);
        if (at == None || !IsOf(at, external))
        {
            at = bodies[slot].Last; // a strategy has it take effect at another key than its own
            while (at != None && !IsOf(at, external))
            {
                at = entries[at].Previous;
            }
        }

        if (at == None)
        {
            key = default;
            return false;
        }

        key = order.Key(at);
        Remove(slot, at);
        return true;
    }

    /// <summary>Removes a body's event of a key, if it is there; if it was due, the one after it is due now.</summary>
    internal void Remove(int slot, in EventKey key)
    {
        int at = FirstFrom(slot, key);
        if (at == None || order.Key(at) != key)
        {
            return;
        }

        if (bodies[slot].Due == at)
        {
            bodies[slot].Due = entries[at].Next;
        }

        Remove(slot, at);
    }

    /// <summary>Whether no event of a body is kept.</summary>
    internal bool IsEmpty(int slot) => bodies[slot].First == None;

    /// <summary>Forgets a body's events keyed before <paramref name="edge"/>; nothing can be cut there any more.</summary>
    internal void DropBefore(int slot, SimTime edge)
    {
        while (bodies[slot].First != None && order.Key(bodies[slot].First).Time < edge)
        {
            Remove(slot, bodies[slot].First);
        }
    }

    /// <summary>The body's first event keyed at or after <paramref name="key"/>, or <see cref="None"/>.</summary>
    internal int FirstFrom(int slot, in EventKey key)
    {
        int before = LastBefore(slot, key);
        return before == None ? bodies[slot].First : entries[before].Next;
    }

    private int LastBefore(int slot, in EventKey key)
    {
        int last = bodies[slot].Last;
        return last == None || EventKey.Compare(order.Key(last), key) < 0 ? last : order.LastBefore(bodies[slot].Root, key);
    }

    private bool IsOf(int at, in ExternalEvent external) =>
        entries[at].Event.Peer == external.Peer && entries[at].Event.Sequence == external.Sequence;

    private void Remove(int slot, int at)
    {
        if (entries[at].Event.WhenOccupied != WhenOccupied.Overlap)
        {
            placings!.Remove(ref placingRoot, at);
        }

        order.Remove(ref bodies[slot].Root, at);
        Link(slot, entries[at].Previous, entries[at].Next);
        entries[at].Next = free;
        free = at;
    }

    /// <summary>Has one entry of a body follow the other; <see cref="None"/> marks the ends.</summary>
    private void Link(int slot, int before, int after)
    {
        (before == None ? ref bodies[slot].First : ref entries[before].Next) = after;
        (after == None ? ref bodies[slot].Last : ref entries[after].Previous) = before;
    }

    private struct Entry
    {
        internal ExternalEvent Event;
        internal int Slot;
        internal bool Forwarded;
        internal int Previous;
        internal int Next;
    }

    /// <summary>A body's events: their tree, the first and the last, and the first that is due.</summary>
    private struct Body
    {
        internal int Root;
        internal int First;
        internal int Last;
        internal int Due;
    }
}
