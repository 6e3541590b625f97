using System;

namespace LagSim.BroadPhase;

/// <summary>The slots that a search has found, each once.</summary>
internal sealed class SlotSet
{
    private int[] found = new int[64];
    private uint[] foundBy; // slot -> the search that found it last
    private uint search;

    /// <summary>Nothing found; with room for as many slots as are expected at first.</summary>
    internal SlotSet(int expected) => foundBy = new uint[expected];

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

    /// <summary>Counts all that is listed as found, so that it is not listed again.</summary>
    internal void Mark()
    {
        for (int i = 0; i < Count; i++)
        {
            foundBy[found[i]] = search;
        }
    }

    /// <summary>Makes room for so many more.</summary>
    internal void Reserve(int more)
    {
        if (Count + more > found.Length)
        {
            Array.Resize(ref found, Math.Max(Count + more, Count * 2));
        }
    }

    /// <summary>
    /// Lists a slot that is not listed yet, if asked to; there must be room for it. The choice is not a branch, because it cannot be
    /// predicted.
    /// </summary>
    internal void AddIf(bool isFound, int slot)
    {
        found[Count] = slot;
        Count += isFound ? 1 : 0;
    }

    /// <summary>Room for that many more. <see cref="Took"/> then says how many were written to it.</summary>
    internal Span<int> Room(int more)
    {
        Reserve(more);
        return found.AsSpan(Count);
    }

    /// <summary>Lists that many slots, which were written to the room.</summary>
    internal void Took(int more) => Count += more;

    /// <summary>Lists a slot unless it was found already.</summary>
    internal void Add(int slot)
    {
        if (foundBy[slot] == search)
        {
            return;
        }

        foundBy[slot] = search;
        Reserve(1);
        found[Count++] = slot;
    }
}
