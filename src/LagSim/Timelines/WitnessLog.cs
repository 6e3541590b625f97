using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// Of every body the impacts for which it was looked at, because it was near, whether or not it then took part: what happens to it can change what
/// came of them.
/// </summary>
/// <remarks>Only impacts of crowded bodies look at what is near, so it is empty where nothing is piled up.</remarks>
internal sealed class WitnessLog
{
    internal const int None = -1;

    private Entry[] entries = new Entry[4];
    private int used;
    private int free = None;
    private int[] first = Array.Empty<int>();

    /// <summary>Makes room for a body's entries.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= first.Length)
        {
            Array.Resize(ref first, Math.Max(slot + 1, Math.Max(16, first.Length * 2)));
        }

        first[slot] = None;
    }

    /// <summary>The first entry of a body, or <see cref="None"/>; in no particular order.</summary>
    internal int First(int slot) => first[slot];

    internal int Next(int entry) => entries[entry].Next;

    /// <summary>The impact.</summary>
    internal ref readonly EventKey Key(int entry) => ref entries[entry].Key;

    /// <summary>The slot of one that takes part in it.</summary>
    internal int Party(int entry) => entries[entry].Party;

    /// <summary>The body was looked at for an impact.</summary>
    internal void Add(int slot, EventKey key, int party, SimTime edge)
    {
        Remove(slot, entry => entry.Key.Time < edge || entry.Key == key);
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

        entries[at] = new Entry { Key = key, Party = party, Next = first[slot] };
        first[slot] = at;
    }

    /// <summary>Takes out what is keyed at or after <paramref name="key"/>; whether anything was.</summary>
    internal bool CutFrom(int slot, EventKey key) => Remove(slot, entry => EventKey.Compare(entry.Key, key) >= 0);

    private bool Remove(int slot, Predicate<Entry> isGone)
    {
        bool any = false;
        int before = None;
        int at = first[slot];
        while (at != None)
        {
            int next = entries[at].Next;
            if (!isGone(entries[at]))
            {
                before = at;
            }
            else
            {
                if (before == None)
                {
                    first[slot] = next;
                }
                else
                {
                    entries[before].Next = next;
                }

                entries[at].Next = free;
                free = at;
                any = true;
            }

            at = next;
        }

        return any;
    }

    private struct Entry
    {
        internal EventKey Key;
        internal int Party;
        internal int Next;
    }
}
