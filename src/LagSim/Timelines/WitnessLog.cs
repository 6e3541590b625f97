using System;
using LagSim.Events;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>
/// Of every body the impacts for which it was looked at, because it was near, whether or not it then took part: what happens to it can change what
/// came of them.
/// </summary>
/// <remarks>
/// Only impacts of crowded bodies look at what is near, so it is empty where nothing is piled up. A body's entries are linked from the newest key to the
/// oldest, so that what is added, cut and forgotten, at the ends, does not cost what is kept between them.
/// </remarks>
internal sealed class WitnessLog
{
    internal const int None = -1;

    private const int FirstRoom = 4;

    private readonly int most;
    private Entry[] entries = Array.Empty<Entry>();
    private int used;
    private int free = None;
    private int[] newest;
    private int[] oldest;

    /// <summary>No entries yet, and at most <paramref name="most"/> of all bodies; with room for as many of those as are expected at first.</summary>
    internal WitnessLog(int most, int expected = 0)
    {
        this.most = most;
        newest = new int[expected];
        oldest = new int[expected];
        Array.Fill(newest, None);
        Array.Fill(oldest, None);
    }

    /// <summary>Makes room for a body's entries; those of the body that had the slot before are forgotten.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= newest.Length)
        {
            int known = newest.Length;
            int size = Math.Max(slot + 1, Math.Max(16, known * 2));
            Array.Resize(ref newest, size);
            Array.Resize(ref oldest, size);
            Array.Fill(newest, None, known, size - known);
            Array.Fill(oldest, None, known, size - known);
        }

        while (newest[slot] != None)
        {
            Remove(slot, newest[slot]);
        }
    }

    /// <summary>The newest entry of a body, or <see cref="None"/>.</summary>
    internal int Newest(int slot) => newest[slot];

    /// <summary>The next older entry of the same body, or <see cref="None"/>.</summary>
    internal int Older(int entry) => entries[entry].Older;

    /// <summary>The impact.</summary>
    internal ref readonly EventKey Key(int entry) => ref entries[entry].Key;

    /// <summary>A segment that it opened, of one who takes part in it.</summary>
    internal int Segment(int entry) => entries[entry].Segment;

    /// <summary>The serial of that segment; while it has that, the impact happens.</summary>
    internal long Serial(int entry) => entries[entry].Serial;

    /// <summary>The body was looked at for an impact, that opened a segment of one who takes part; what lies before the edge is forgotten.</summary>
    /// <exception cref="TimelinesFullException">There are as many entries as may be.</exception>
    internal void Add(int slot, in EventKey key, int segment, long serial, SimTime edge)
    {
        while (oldest[slot] != None && entries[oldest[slot]].Key.Time < edge)
        {
            Remove(slot, oldest[slot]);
        }

        int newer = None;
        int older = newest[slot];
        while (older != None && EventKey.Compare(entries[older].Key, key) > 0)
        {
            newer = older;
            older = entries[older].Older;
        }

        if (older != None && entries[older].Key == key)
        {
            (entries[older].Segment, entries[older].Serial) = (segment, serial);
            return;
        }

        int at = Take(key);
        entries[at] = new Entry { Key = key, Segment = segment, Serial = serial };
        Join(slot, newer, at);
        Join(slot, at, older);
    }

    /// <summary>Takes out what is keyed at or after <paramref name="key"/>; whether anything was.</summary>
    internal bool CutFrom(int slot, in EventKey key)
    {
        bool any = false;
        while (newest[slot] != None && EventKey.Compare(entries[newest[slot]].Key, key) >= 0)
        {
            Remove(slot, newest[slot]);
            any = true;
        }

        return any;
    }

    private int Take(in EventKey key)
    {
        if (free != None)
        {
            int taken = free;
            free = entries[taken].Older;
            return taken;
        }

        if (used == most)
        {
            throw new TimelinesFullException(
                $"At {key.Time.ToShortString()} {most} looks at bodies near an impact are kept, as many as the segments that the options allow: allow more,"
                + " keep a shorter history, or look for what piles up.");
        }

        if (used == entries.Length)
        {
            Array.Resize(ref entries, Math.Max(FirstRoom, used * 2));
        }

        return used++;
    }

    private void Remove(int slot, int at)
    {
        Join(slot, entries[at].Newer, entries[at].Older);
        entries[at].Older = free;
        free = at;
    }

    /// <summary>Makes two entries of a body neighbours; in place of one that there is not, the other is the end of the list.</summary>
    private void Join(int slot, int newer, int older)
    {
        if (newer == None)
        {
            newest[slot] = older;
        }
        else
        {
            entries[newer].Older = older;
        }

        if (older == None)
        {
            oldest[slot] = newer;
        }
        else
        {
            entries[older].Newer = newer;
        }
    }

    private struct Entry
    {
        internal EventKey Key;
        internal int Segment;
        internal long Serial;
        internal int Older;
        internal int Newer;
    }
}
