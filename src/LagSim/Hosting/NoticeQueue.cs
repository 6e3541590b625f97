using System.Threading;

namespace LagSim.Hosting;

/// <summary>
/// Hands notices from the simulation's thread to one reading thread, in order, without a lock and without waiting: a ring of fixed
/// size.
/// </summary>
internal sealed class NoticeQueue<T>
    where T : struct
{
    private readonly T[] ring;
    private long written; // by the writer alone
    private long read; // by the reader alone

    internal NoticeQueue(int capacity) => ring = new T[capacity];

    internal int Capacity => ring.Length;

    /// <summary>Puts one in, if no more than that would then be waiting. For the writer.</summary>
    internal bool TryWrite(in T notice, int most)
    {
        if (written - Volatile.Read(ref read) >= most)
        {
            return false;
        }

        ring[(int)(written % ring.Length)] = notice;
        Volatile.Write(ref written, written + 1);
        return true;
    }

    /// <summary>Takes the oldest out. For the reader.</summary>
    internal bool TryRead(out T notice)
    {
        if (read == Volatile.Read(ref written))
        {
            notice = default!;
            return false;
        }

        notice = ring[(int)(read % ring.Length)];
        Volatile.Write(ref read, read + 1);
        return true;
    }
}
