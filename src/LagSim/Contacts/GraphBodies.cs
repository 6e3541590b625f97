using System;
using LagSim.Timelines;

namespace LagSim.Contacts;

/// <summary>The bodies of a <see cref="ContactGraph"/>, numbered within it.</summary>
/// <remarks>Cost: of sorting n log n, of finding a number none. Allocates only when there are more bodies than ever before.</remarks>
internal sealed class GraphBodies(BodyTable bodies)
{
    private int[] slots = new int[2]; // as many as nearly all impacts have
    private int[] numbers = new int[2]; // by slot: meant only where the body of that number has that slot
    private long[] keys = Array.Empty<long>();

    internal int Count { get; private set; }

    /// <summary>By number.</summary>
    internal Span<int> Slots => slots.AsSpan(0, Count);

    internal void Clear() => Count = 0;

    /// <summary>Adds one that is not there.</summary>
    internal int Add(int slot)
    {
        if (Count == slots.Length)
        {
            Array.Resize(ref slots, Count * 2);
        }

        if (slot >= numbers.Length)
        {
            Array.Resize(ref numbers, Math.Max(bodies.Room, slot + 1));
        }

        slots[Count] = slot;
        numbers[slot] = Count;
        return Count++;
    }

    /// <summary>Leaves out all from a number on.</summary>
    internal void Keep(int count) => Count = count;

    /// <summary>The number of a body, or -1 if it is not there.</summary>
    internal int IndexOf(int slot)
    {
        int number = (uint)slot < (uint)numbers.Length ? numbers[slot] : Count;
        return number < Count && slots[number] == slot ? number : -1;
    }

    /// <summary>Numbers them in the order of their identities.</summary>
    internal void Sort()
    {
        if (keys.Length < Count)
        {
            keys = new long[slots.Length];
        }

        bool isSorted = true;
        for (int i = 0; i < Count; i++)
        {
            keys[i] = (long)(bodies.Id(slots[i]).Packed ^ (1UL << 63)); // signed numbers in the order of unsigned ones
            isSorted &= i == 0 || keys[i] > keys[i - 1];
        }

        if (isSorted)
        {
            return;
        }

        Array.Sort(keys, slots, 0, Count);
        for (int i = 0; i < Count; i++)
        {
            numbers[slots[i]] = i;
        }
    }
}
