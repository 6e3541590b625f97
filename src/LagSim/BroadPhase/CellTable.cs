using System;

namespace LagSim.BroadPhase;

/// <summary>The values in each cell of a grid: lists by the cell's number, in a hash table that is emptied as a whole.</summary>
/// <typeparam name="T">The type of the values.</typeparam>
internal sealed class CellTable<T>
    where T : struct
{
    internal const int None = -1;

    private int[] heads;
    private Entry[] entries;

    internal CellTable(int capacity)
    {
        int size = 64;
        while (size < capacity)
        {
            size *= 2;
        }

        heads = new int[size];
        entries = new Entry[size];
        Array.Fill(heads, None);
    }

    /// <summary>How many entries there are, of all cells; they are numbered from 0.</summary>
    internal int Count { get; private set; }

    /// <summary>The first entry that may be of the cell, or <see cref="None"/>; entries of other cells may be in between.</summary>
    internal int First(ulong cell) => heads[Bucket(cell)];

    internal int Next(int entry) => entries[entry].Next;

    internal ulong Cell(int entry) => entries[entry].Cell;

    internal ref readonly T Value(int entry) => ref entries[entry].Value;

    internal void Add(ulong cell, in T value)
    {
        if (Count == entries.Length)
        {
            Grow();
        }

        ref int head = ref heads[Bucket(cell)];
        entries[Count] = new Entry { Cell = cell, Value = value, Next = head };
        head = Count++;
    }

    /// <summary>Puts another value in the place of one.</summary>
    internal void Replace(int entry, in T value) => entries[entry].Value = value;

    internal void Clear()
    {
        Array.Fill(heads, None);
        Count = 0;
    }

    private int Bucket(ulong cell) => CellGrid.Bucket(cell, heads.Length);

    private void Grow()
    {
        Array.Resize(ref entries, Count * 2);
        heads = new int[Count * 2];
        Array.Fill(heads, None);
        for (int at = 0; at < Count; at++)
        {
            ref int head = ref heads[Bucket(entries[at].Cell)];
            entries[at].Next = head;
            head = at;
        }
    }

    private struct Entry
    {
        internal ulong Cell;
        internal T Value;
        internal int Next;
    }
}
