using System;
using LagSim.Time;

namespace LagSim.Collisions;

/// <summary>
/// What was last found out about the contacts of an instant: up to which segments of the two it was counted how often they were struck, and
/// how often that was.
/// </summary>
/// <remarks>It only saves time: without it the cost of an instant grows with the square of its rounds. A new instant empties it.</remarks>
internal sealed class StrikeTable
{
    private const int Least = 64; // a power of two

    private Entry[] entries = new Entry[Least];
    private int used;
    private SimTime time;

    /// <summary>The entry of two, empty if there is none yet; until the next call.</summary>
    /// <param name="first">The place of a body.</param>
    /// <param name="second">That of the other, or the complement of a surface.</param>
    /// <param name="instant">The instant.</param>
    internal ref Entry Find(int first, int second, SimTime instant)
    {
        if (instant != time)
        {
            Empty();
            time = instant;
        }

        if (4 * used >= 3 * entries.Length)
        {
            Grow();
        }

        ref Entry entry = ref PlaceOf(Entry.PairOf(first, second));
        used += entry.IsUsed ? 0 : 1;
        entry.Use(first, second);
        return ref entry;
    }

    private void Empty()
    {
        if (entries.Length > Least)
        {
            entries = new Entry[Least];
        }
        else if (used > 0)
        {
            Array.Clear(entries, 0, entries.Length);
        }

        used = 0;
    }

    private void Grow()
    {
        Entry[] former = entries;
        entries = new Entry[2 * former.Length];
        for (int n = 0; n < former.Length; n++)
        {
            if (former[n].IsUsed)
            {
                PlaceOf(former[n].Pair) = former[n];
            }
        }
    }

    /// <summary>Where a pair is, or would be.</summary>
    private ref Entry PlaceOf(ulong pair)
    {
        int mask = entries.Length - 1;
        int at = (int)((pair * 0x9E37_79B9_7F4A_7C15) >> 32) & mask; // Fibonacci hashing, Knuth, TAOCP 3, 6.4
        while (entries[at].IsUsed && entries[at].Pair != pair)
        {
            at = (at + 1) & mask;
        }

        return ref entries[at];
    }

    /// <summary>What is known of one contact.</summary>
    internal struct Entry
    {
        /// <summary>The two.</summary>
        internal ulong Pair { get; private set; }

        /// <summary>Whether it is of any contact.</summary>
        internal bool IsUsed { get; private set; }

        /// <summary>The serial number of the first one's segment up to which it was counted. Serial numbers begin at 1.</summary>
        internal long First { get; private set; }

        /// <summary>That of the second one's, or the complement of the surface.</summary>
        internal long Second { get; private set; }

        /// <summary>How often they were struck; two where it is more.</summary>
        internal int Strikes { get; private set; }

        /// <summary>The two as one number.</summary>
        internal static ulong PairOf(int first, int second) => ((ulong)(uint)first << 32) | (uint)second;

        /// <summary>Makes it that of two.</summary>
        internal void Use(int first, int second)
        {
            Pair = PairOf(first, second);
            IsUsed = true;
        }

        /// <summary>Notes what was counted.</summary>
        internal void Note(long first, long second, int strikes)
        {
            First = first;
            Second = second;
            Strikes = strikes;
        }
    }
}
