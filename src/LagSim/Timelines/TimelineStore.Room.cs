using System;
using LagSim.Time;

namespace LagSim.Timelines;

/// <content>Room: what lies behind the window is dropped when there is none left, and if that was little, there is more.</content>
internal sealed partial class TimelineStore
{
    /// <summary>Below this the arrays double, above they grow by one part in <see cref="Growth"/>.</summary>
    private const int Large = 1024;

    private const int Growth = 64;

    private const int FirstRoom = 4;

    /// <summary>If all that can be dropped is less than one part in so many, it would soon be looked for again.</summary>
    private const int LittleRoom = 32;

    /// <summary>For how many segments there is room without more memory.</summary>
    internal int Room => pieces.Length;

    /// <summary>Instants before this are asked for no more; what only they need is dropped when room is needed.</summary>
    internal void ForgetBefore(SimTime time) => edge = SimTime.Max(edge, time);

    /// <summary>Drops of one body what is no longer needed for instants from <paramref name="time"/> on; the last segment opened before it stays.</summary>
    internal void DropBefore(int slot, SimTime time)
    {
        int at = first[slot];
        while (at != None && links[at].Closed < time)
        {
            int next = links[at].Next;
            Drop(at);
            at = next;
        }
    }

    /// <summary>Drops what lies behind the window; and makes room for more if that was little, else it would soon be looked for again.</summary>
    private void DropAll(SimTime now)
    {
        // From the end, so that what is freed is given out from the beginning: whoever opens segments goes through memory in one direction.
        for (int at = used - 1; at >= 0; at--)
        {
            if (links[at].Closed < edge)
            {
                Drop(at);
            }
        }

        if (Alive > used - (used / LittleRoom) && used < Most)
        {
            Grow(now);
        }
    }

    /// <summary>Takes a segment that has a successor out of its timeline; those before it, which are older, are dropped with it.</summary>
    private void Drop(int at)
    {
        int previous = links[at].Previous;
        int next = links[at].Next;
        links[next].Previous = previous;
        if (previous == None)
        {
            first[links[at].Owner] = next;
        }
        else
        {
            links[previous].Next = next;
        }

        Release(at);
    }

    private void Release(int at)
    {
        links[at].Serial = 0;
        links[at].Closed = SimTime.MaxValue; // nothing that could be dropped
        links[at].Next = free;
        free = at;
        Alive--;
    }

    private void Grow(SimTime now)
    {
        int size = pieces.Length < Large ? pieces.Length * 2 : Math.Max(pieces.Length + (pieces.Length / Growth), Expected(now));
        Array.Resize(ref pieces, size);
        Array.Resize(ref links, size);
        if (dense.Length > 0)
        {
            Array.Resize(ref dense, size);
        }

        if (holds.Length > 0)
        {
            Array.Resize(ref holds, size);
        }

        if (spins.Length > 0)
        {
            Array.Resize(ref spins, size);
        }
    }

    /// <summary>
    /// For how many segments room will be needed, as far as can be told before a whole history has gone by: if as many are opened for the rest of it, from an
    /// eighth of it on. No more than a quarter above what there is, for what begins need not go on. To grow by little until then would be to copy everything
    /// some hundred times.
    /// </summary>
    private int Expected(SimTime now)
    {
        double passed = now.SecondsSince(origin);
        double whole = history.ToSeconds();
        if (!(passed > whole / 8 && passed < whole))
        {
            return 0;
        }

        double opened = (used - first.Length) * (whole / passed);
        return (int)Math.Min(first.Length + opened, pieces.Length * 1.25);
    }
}
