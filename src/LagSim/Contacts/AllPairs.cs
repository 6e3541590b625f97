using System;
using LagSim.Motion;

namespace LagSim.Contacts;

/// <summary>The index that is none: every body is a candidate. Right for up to some hundreds of bodies.</summary>
internal sealed class AllPairs : IPairIndex
{
    private int[] known = new int[16];
    private int[] place = new int[16]; // slot -> 1 + position in known; 0: not there
    private int count;

    public void Place(int slot, in MotionSegment segment)
    {
        if (slot >= place.Length)
        {
            Array.Resize(ref place, Math.Max(slot + 1, place.Length * 2));
        }

        if (place[slot] != 0)
        {
            return;
        }

        if (count == known.Length)
        {
            Array.Resize(ref known, count * 2);
        }

        known[count++] = slot;
        place[slot] = count;
    }

    public void Forget(int slot)
    {
        int hole = slot < place.Length ? place[slot] - 1 : -1;
        if (hole < 0)
        {
            return; // heard of, but never there
        }

        int last = known[--count];
        known[hole] = last;
        place[last] = hole + 1;
        place[slot] = 0;
    }

    public Span<int> Candidates(int slot) => known.AsSpan(0, count);
}
