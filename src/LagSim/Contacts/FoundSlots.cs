using System;

namespace LagSim.Contacts;

/// <summary>The slots that a search has found, each once.</summary>
internal sealed class FoundSlots
{
    private int[] found = new int[64];
    private uint[] foundBy = new uint[16]; // slot -> the search that found it last
    private uint search;

    internal int Count { get; private set; }

    internal Span<int> Slots => found.AsSpan(0, Count);

    /// <summary>Makes room for a slot.</summary>
    internal void AddSlot(int slot)
    {
        if (slot >= foundBy.Length)
        {
            Array.Resize(ref foundBy, Math.Max(slot + 1, foundBy.Length * 2));
        }
    }

    /// <summary>Another search begins.</summary>
    internal void Clear()
    {
        Count = 0;
        if (++search == 0)
        {
            Array.Clear(foundBy, 0, foundBy.Length);
            search = 1;
        }
    }

    /// <summary>Counts a slot as found, but does not list it.</summary>
    internal void Skip(int slot) => foundBy[slot] = search;

    internal void Add(int slot)
    {
        if (foundBy[slot] == search)
        {
            return;
        }

        foundBy[slot] = search;
        if (Count == found.Length)
        {
            Array.Resize(ref found, Count * 2);
        }

        found[Count++] = slot;
    }
}
