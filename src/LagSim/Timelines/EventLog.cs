using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>The external events of every body inside the window, in canonical order, so that a rolled-back body meets them again.</summary>
internal sealed class EventLog
{
    internal const int None = -1;

    private Entry[] entries = new Entry[16];
    private int used;
    private int free = None;
    private int[] first = Array.Empty<int>();

    /// <summary>Makes room for a body's events.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= first.Length)
        {
            Array.Resize(ref first, Math.Max(slot + 1, Math.Max(16, first.Length * 2)));
        }

        first[slot] = None;
    }

    internal ref readonly ExternalEvent Event(int entry) => ref entries[entry].Event;

    /// <summary>Where in the order it takes effect: its own key, or the arrival where a strategy applies it late.</summary>
    internal ref readonly EventKey Key(int entry) => ref entries[entry].Key;

    /// <summary>Whether it is applied by advancing the body alone from the event's stamp to the key's time.</summary>
    internal bool IsForwarded(int entry) => entries[entry].Forwarded;

    internal int Next(int entry) => entries[entry].Next;

    /// <summary>Adds an event and tells its entry; false if the body has one of that key, which is then the same event heard again.</summary>
    internal bool TryAdd(int slot, in ExternalEvent external, in EventKey key, bool forwarded, out int entry)
    {
        int before = None;
        int after = first[slot];
        while (after != None && EventKey.Compare(entries[after].Key, key) < 0)
        {
            before = after;
            after = entries[after].Next;
        }

        entry = after;
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
                Array.Resize(ref entries, used * 2);
            }
        }

        entries[at] = new Entry { Event = external, Key = key, Forwarded = forwarded, Next = after };
        if (before == None)
        {
            first[slot] = at;
        }
        else
        {
            entries[before].Next = at;
        }

        entry = at;
        return true;
    }

    /// <summary>Takes the event (peer, sequence) of a body out; false if there is none.</summary>
    internal bool TryRemove(int slot, byte peer, uint sequence, out EventKey key)
    {
        int before = None;
        for (int at = first[slot]; at != None; before = at, at = entries[at].Next)
        {
            if (entries[at].Event.Peer == peer && entries[at].Event.Sequence == sequence)
            {
                key = entries[at].Key;
                Unlink(slot, before, at);
                return true;
            }
        }

        key = default;
        return false;
    }

    /// <summary>Whether no event of a body is kept.</summary>
    internal bool IsEmpty(int slot) => first[slot] == None;

    /// <summary>Forgets a body's events keyed before <paramref name="edge"/>; nothing can be cut there any more.</summary>
    internal void DropBefore(int slot, SimTime edge)
    {
        while (first[slot] != None && entries[first[slot]].Key.Time < edge)
        {
            Unlink(slot, None, first[slot]);
        }
    }

    /// <summary>The body's first event keyed at or after <paramref name="key"/>, or <see cref="None"/>.</summary>
    internal int FirstFrom(int slot, in EventKey key)
    {
        int at = first[slot];
        while (at != None && EventKey.Compare(entries[at].Key, key) < 0)
        {
            at = entries[at].Next;
        }

        return at;
    }

    private void Unlink(int slot, int before, int at)
    {
        if (before == None)
        {
            first[slot] = entries[at].Next;
        }
        else
        {
            entries[before].Next = entries[at].Next;
        }

        entries[at].Next = free;
        free = at;
    }

    private struct Entry
    {
        internal ExternalEvent Event;
        internal EventKey Key;
        internal bool Forwarded;
        internal int Next;
    }
}
