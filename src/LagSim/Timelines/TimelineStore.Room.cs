using System;
using LagSim.Time;

namespace LagSim.Timelines;

/// <content>Room: when none is left, segments behind the window are dropped, and if those were few, the store grows.</content>
internal partial class TimelineStore
{
    /// <summary>Below this the arrays double, above they grow by one part in <see cref="Growth"/>.</summary>
    private const int Large = 1024;

    private const int Growth = 64;

    private const int FirstRoom = 4;

    /// <summary>The room for a whole window is estimated from the segments opened in one part in this many.</summary>
    private const ulong RecentPart = 8;

    /// <summary>The number of segments of each body that is enough for an estimate, however short the time.</summary>
    private const int Many = 64;

    /// <summary>If all that can be dropped is less than one part in this many, the search would soon be due again.</summary>
    private const int LittleRoom = 32;

    /// <summary>The number of segments that there is room for without more memory.</summary>
    internal int Room => pieces.Length;

    /// <summary>Instants before this are asked for no more; what only they need is dropped when room is needed.</summary>
    internal void ForgetBefore(SimTime time) => edge = SimTime.Max(edge, time);

    /// <summary>
    /// Drops of one body what is no longer needed for instants from <paramref name="time"/> on; the last segment opened before it stays.
    /// </summary>
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

    /// <summary>
    /// Drops the segments behind the window, and makes room for more if those were few: otherwise the search would soon be due again.
    /// </summary>
    private void DropAll(SimTime now)
    {
        int recent = 0;
        SimTime late = SinceWhen(now);

        // From the end, so that freed room is given out from the beginning: opening segments goes through memory in one direction.
        for (int at = used - 1; at >= 0; at--)
        {
            SimTime closed = links[at].Closed;
            if (closed < edge)
            {
                Drop(at);
            }
            else if (closed > late && closed <= now)
            {
                recent++;
            }
        }

        if (Alive > used - (used / LittleRoom) && used < Most)
        {
            Grow(now, recent);
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
        if (pieces[at].Segment.IsOfIsland)
        {
            Carried.Release(at);
        }

        links[at].Serial = 0;
        links[at].Closed = SimTime.MaxValue; // nothing that could be dropped
        links[at].Next = free;
        free = at;
        Alive--;
    }

    /// <param name="now">When there is no room left.</param>
    /// <param name="recent">How many segments were closed in the last part of the window.</param>
    private void Grow(SimTime now, int recent)
    {
        int size = pieces.Length < Large ? pieces.Length * 2 : Math.Max(pieces.Length + (pieces.Length / Growth), Expected(now, recent));
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

        Carried.Grow(size);
    }

    /// <summary>
    /// When the last part of what is kept began. The span since the edge may exceed the range of a long; as an unsigned difference it never
    /// does.
    /// </summary>
    private SimTime SinceWhen(SimTime now) =>
        now <= edge ? now : SimTime.FromTicks(now.Ticks - (long)(((ulong)now.Ticks - (ulong)edge.Ticks) / RecentPart));

    /// <summary>
    /// An estimate of the number of segments that room will be needed for. Once a whole history has gone by, it assumes that as many are
    /// opened as in the last part of what is kept, less two standard deviations of such a number, so that at an even rate that is no more
    /// than there is. Before, it assumes that as many are opened for the rest of the history, from an eighth of it on, or from where each
    /// body has many. It is no more than a quarter above what there is, because a beginning need not continue. Growing by little where more
    /// and more are opened would copy everything some hundred times.
    /// </summary>
    private protected virtual int Expected(SimTime now, int recent)
    {
        double opened = (recent - (2 * Math.Sqrt(recent))) * RecentPart;
        if (edge <= origin)
        {
            double passed = now.SecondsSince(origin), whole = history.ToSeconds();
            int soFar = used - first.Length;
            bool tells = passed < whole && (passed > whole / 8 || soFar > Many * first.Length);
            opened = tells ? soFar * (whole / passed) : 0; // infinite at the very beginning
        }

        return (int)Math.Min(first.Length + opened, pieces.Length * 1.25);
    }
}
