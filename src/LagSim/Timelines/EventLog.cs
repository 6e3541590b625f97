using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>The external events of every body inside the window, in canonical order, so that a rolled-back body meets them again.</summary>
/// <remarks>Looks from the newest on, since most late events are about what happened last.</remarks>
internal sealed class EventLog
{
    internal const int None = -1;

    private const int FirstRoom = 16;

    private Entry[] entries = Array.Empty<Entry>();
    private int used;
    private int free = None;
    private int[] first;
    private int[] last;
    private int[] due;
    private readonly List<(int Slot, EventKey Key)> placings = new(); // events whose effect depends on where other bodies are

    /// <summary>No events yet; with room for as many bodies as are expected at first.</summary>
    internal EventLog(int expected = 0)
    {
        first = new int[expected];
        last = new int[expected];
        due = new int[expected];
    }

    /// <summary>Makes room for a body's events.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= first.Length)
        {
            int size = Math.Max(slot + 1, Math.Max(16, first.Length * 2));
            Array.Resize(ref first, size);
            Array.Resize(ref last, size);
            Array.Resize(ref due, size);
        }

        first[slot] = None;
        last[slot] = None;
        due[slot] = None;
    }

    /// <summary>The body's first event that is not applied yet, or is to be applied again; <see cref="None"/> if there is none.</summary>
    internal int Due(int slot) => due[slot];

    /// <summary>Takes the event that is due: the one after it is due now.</summary>
    internal int TakeDue(int slot)
    {
        int taken = due[slot];
        due[slot] = entries[taken].Next;
        return taken;
    }

    /// <summary>The body's events from the key on are due, and none before it.</summary>
    internal void SetDueFrom(int slot, in EventKey key) => due[slot] = FirstFrom(slot, key);

    /// <summary>The body's events from the key on are due, also again; those before it that are still due stay so.</summary>
    internal void AddDueFrom(int slot, in EventKey key)
    {
        int from = FirstFrom(slot, key);
        if (from != None && (due[slot] == None || EventKey.Compare(entries[from].Key, entries[due[slot]].Key) < 0))
        {
            due[slot] = from;
        }
    }

    internal ref readonly ExternalEvent Event(int entry) => ref entries[entry].Event;

    /// <summary>Where in the order it takes effect: its own key, or the arrival where a strategy applies it late.</summary>
    internal ref readonly EventKey Key(int entry) => ref entries[entry].Key;

    /// <summary>Whether it is applied by advancing the body alone from the event's stamp to the key's time.</summary>
    internal bool IsForwarded(int entry) => entries[entry].Forwarded;

    /// <summary>How many events are kept whose effect depends on where other bodies are when they come.</summary>
    internal int PlacingCount => placings.Count;

    /// <summary>One of those.</summary>
    internal (int Slot, EventKey Key) Placing(int n) => placings[n];

    internal int Next(int entry) => entries[entry].Next;

    /// <summary>Adds an event; false if the body has one of that key, which is then the same event received again.</summary>
    internal bool TryAdd(int slot, in ExternalEvent external, in EventKey key, bool forwarded)
    {
        int before = LastBefore(slot, key);
        int after = before == None ? first[slot] : entries[before].Next;
        if (after != None && entries[after].Key == key)
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

        entries[at] = new Entry { Event = external, Key = key, Forwarded = forwarded };
        Link(slot, before, at);
        Link(slot, at, after);
        if (external.WhenOccupied != WhenOccupied.Overlap)
        {
            placings.Add((slot, key));
        }

        return true;
    }

    /// <summary>Removes the event (peer, sequence) of a body; false if there is none.</summary>
    internal bool TryRemove(int slot, byte peer, uint sequence, out EventKey key)
    {
        for (int at = last[slot]; at != None; at = entries[at].Previous)
        {
            if (entries[at].Event.Peer == peer && entries[at].Event.Sequence == sequence)
            {
                key = entries[at].Key;
                Remove(slot, at);
                return true;
            }
        }

        key = default;
        return false;
    }

    /// <summary>Removes a body's event of a key, if it is there; if it was due, the one after it is due now.</summary>
    internal void Remove(int slot, in EventKey key)
    {
        int at = FirstFrom(slot, key);
        if (at == None || entries[at].Key != key)
        {
            return;
        }

        if (due[slot] == at)
        {
            due[slot] = entries[at].Next;
        }

        Remove(slot, at);
    }

    /// <summary>Whether no event of a body is kept.</summary>
    internal bool IsEmpty(int slot) => first[slot] == None;

    /// <summary>Forgets a body's events keyed before <paramref name="edge"/>; nothing can be cut there any more.</summary>
    internal void DropBefore(int slot, SimTime edge)
    {
        while (first[slot] != None && entries[first[slot]].Key.Time < edge)
        {
            Remove(slot, first[slot]);
        }
    }

    /// <summary>The body's first event keyed at or after <paramref name="key"/>, or <see cref="None"/>.</summary>
    internal int FirstFrom(int slot, in EventKey key)
    {
        int before = LastBefore(slot, key);
        return before == None ? first[slot] : entries[before].Next;
    }

    private int LastBefore(int slot, in EventKey key)
    {
        int at = last[slot];
        while (at != None && EventKey.Compare(entries[at].Key, key) >= 0)
        {
            at = entries[at].Previous;
        }

        return at;
    }

    private void Remove(int slot, int at)
    {
        if (entries[at].Event.WhenOccupied != WhenOccupied.Overlap)
        {
            placings.Remove((slot, entries[at].Key));
        }

        Link(slot, entries[at].Previous, entries[at].Next);
        entries[at].Next = free;
        free = at;
    }

    /// <summary>Has one entry of a body follow the other; <see cref="None"/> marks the ends.</summary>
    private void Link(int slot, int before, int after)
    {
        (before == None ? ref first[slot] : ref entries[before].Next) = after;
        (after == None ? ref last[slot] : ref entries[after].Previous) = before;
    }

    private struct Entry
    {
        internal ExternalEvent Event;
        internal EventKey Key;
        internal bool Forwarded;
        internal int Previous;
        internal int Next;
    }
}
