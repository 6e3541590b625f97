using System;
using LagSim.Time;

namespace LagSim.BroadPhase;

/// <summary>The brute-force broad phase: every body is a candidate, for ever. The fastest for some tens of bodies.</summary>
internal class BruteForce : IBroadPhase
{
    private int[] known = new int[4];
    private int[] place = new int[4]; // slot -> 1 + position in known; 0: not there
    private int count;

    public Span<int> Candidates(int slot, double radius, SimTime from, long heal, out SimTime until)
    {
        Know(slot);
        until = SimTime.MaxValue;
        return known.AsSpan(0, count);
    }

    public Span<int> CandidatesAt(int slot, double radius, SimTime time, bool isHealing) => known.AsSpan(0, count);

    public void Add(int slot, double radius, int segment, SimTime from, SimTime until) => Know(slot);

    public void Forget(int slot)
    {
        int hole = slot < place.Length ? place[slot] - 1 : -1;
        if (hole < 0)
        {
            return; // known by name, but never there
        }

        int last = known[--count];
        known[hole] = last;
        place[last] = hole + 1;
        place[slot] = 0;
    }

    public void DropBefore(SimTime edge)
    {
    }

    private void Know(int slot)
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
}
