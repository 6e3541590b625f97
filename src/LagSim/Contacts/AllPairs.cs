using System;
using LagSim.Motion;

namespace LagSim.Contacts;

/// <summary>The index that is none: every body that is there is a candidate. Right for up to some hundreds of bodies.</summary>
internal sealed class AllPairs : IPairIndex
{
    private int[] present = new int[16];
    private int[] place = new int[16]; // slot -> 1 + position in present; 0: not there
    private int count;

    public void Place(int slot, in MotionSegment segment)
    {
        if (slot >= place.Length)
        {
            Array.Resize(ref place, Math.Max(slot + 1, place.Length * 2));
        }

        if (segment.IsPresent == (place[slot] != 0))
        {
            return;
        }

        if (segment.IsPresent)
        {
            if (count == present.Length)
            {
                Array.Resize(ref present, count * 2);
            }

            present[count++] = slot;
            place[slot] = count;
        }
        else
        {
            int hole = place[slot] - 1;
            int last = present[--count];
            present[hole] = last;
            place[last] = hole + 1;
            place[slot] = 0;
        }
    }

    public Span<int> Candidates(int slot) => present.AsSpan(0, count);
}
