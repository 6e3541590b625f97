using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.BroadPhase;

/// <summary>
/// Time in slabs of an eighth of a second, each with a table of what is listed in which cell then; old slabs are dropped as a whole and
/// used again.
/// </summary>
internal sealed class SlabRing
{
    private const int SlabBits = 37; // 2^37 ticks are 1/8 s

    private readonly Stack<CellTable<PastShells.Stay>> spare = new();
    private CellTable<PastShells.Stay>?[] slabs = new CellTable<PastShells.Stay>?[16]; // by number, from first on
    private long first;
    private int count;

    /// <summary>The number of the slab that an instant lies in.</summary>
    internal static long NumberOf(SimTime time) => time.Ticks >> SlabBits;

    /// <summary>The first instant after a slab.</summary>
    internal static SimTime EndOf(long number) =>
        number >= long.MaxValue >> SlabBits ? SimTime.MaxValue : SimTime.FromTicks((number + 1) << SlabBits);

    /// <summary>The first slab from a number on that may hold anything, and how many there are from it on.</summary>
    internal long From(long number, out int slabsLeft)
    {
        long from = Math.Max(number, first);
        slabsLeft = (int)Math.Max(0, first + count - from);
        return from;
    }

    /// <summary>A slab in which a body may be listed; null for any other.</summary>
    internal CellTable<PastShells.Stay>? Find(long number) => number >= first && number < first + count ? slabs[number - first] : null;

    /// <summary>A slab, to list a body in it.</summary>
    internal CellTable<PastShells.Stay> Get(long number)
    {
        first = count == 0 ? number : first;
        if (number < first)
        {
            int missing = (int)(first - number);
            CellTable<PastShells.Stay>?[] shifted = new CellTable<PastShells.Stay>?[Math.Max(slabs.Length, count + missing)];
            Array.Copy(slabs, 0, shifted, missing, count);
            slabs = shifted;
            first = number;
            count += missing;
        }

        int at = (int)(number - first);
        if (at >= slabs.Length)
        {
            Array.Resize(ref slabs, Math.Max(at + 1, slabs.Length * 2));
        }

        count = Math.Max(count, at + 1);
        return slabs[at] ??= spare.Count > 0 ? spare.Pop() : new CellTable<PastShells.Stay>(at > 0 && slabs[at - 1] is { } before ? before.Count : 64);
    }

    /// <summary>Drops the slabs that end before an instant.</summary>
    internal void DropBefore(SimTime edge)
    {
        int dropped = (int)Math.Max(0, Math.Min(count, NumberOf(edge) - first));
        if (count == 0 || dropped == 0)
        {
            return;
        }

        for (int i = 0; i < dropped; i++)
        {
            if (slabs[i] is { } old)
            {
                old.Clear();
                spare.Push(old);
            }
        }

        Array.Copy(slabs, dropped, slabs, 0, count - dropped);
        Array.Clear(slabs, count - dropped, dropped);
        count -= dropped;
        first += dropped;
    }
}
