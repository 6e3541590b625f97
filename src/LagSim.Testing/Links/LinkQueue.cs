using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>A <see cref="Links.Bottleneck"/> in operation: a queue, and the line behind it. Several directions may share one.</summary>
/// <remarks>
/// <para>First in, first out. With drop-tail a datagram's fate is known when it arrives, since it depends on nothing later. With CoDel it
/// is not: drops at the head depend on how much waits behind by then. So the fate is decided when the datagram is next, and its sender is
/// notified then (<see cref="NextDecision"/>, <see cref="DecideUntil"/>): as in RFC 8289, nothing is guessed.</para>
/// <para>The next datagram is chosen when the one before it has left, and is then served by the token bucket. Until it leaves it occupies
/// room in the queue, but does not count as waiting for CoDel; both as in the kernel.</para>
/// <para>Deterministic: the same datagrams at the same times have the same fates; the only random draw is where a dip's period begins. Not
/// thread-safe.</para>
/// </remarks>
internal sealed class LinkQueue
{
    /// <summary>The most bytes of its own that a UDP datagram has.</summary>
    internal const int MaxBytes = 65_507;

    private readonly TokenBucket bucket;
    private readonly CoDel? codel;
    private readonly WaitingLine waiting;
    private readonly Queue<(int Bytes, SimTime At)> leaving = new(); // decided, not gone yet
    private readonly List<BulkTransfer> transfers = []; // bulk transfers through this queue, which send by themselves
    private long leavingBytes;
    private SimTime lastCame = SimTime.MinValue;
    private SimTime free = SimTime.MinValue; // when the last decided datagram has left
    private bool idle = true; // nothing arrived since then; CoDel knows it

    /// <summary>Creates an empty queue whose line has been idle.</summary>
    /// <param name="bottleneck">Its rate, size and discipline.</param>
    /// <param name="path">
    /// The random generator of the path, which decides where a dip's period begins; only <see cref="SeededRandom.Fork"/> is called on it.
    /// Default: one begins at time zero.
    /// </param>
    public LinkQueue(Bottleneck bottleneck, SeededRandom? path = null)
        : this(bottleneck, path is null ? 0 : LinkModel.Phase(path))
    {
    }

    internal LinkQueue(Bottleneck bottleneck, double phase)
    {
        ArgumentNullException.ThrowIfNull(bottleneck);
        Bottleneck = bottleneck;
        bucket = new TokenBucket(bottleneck, phase);
        waiting = new WaitingLine(this);
        codel = bottleneck.Discipline == QueueDiscipline.CoDel ? new CoDel(waiting) : null;
    }

    /// <summary>Its rate, size and discipline.</summary>
    public Bottleneck Bottleneck { get; }

    /// <summary>Whether the line is in a dip at that time.</summary>
    public bool IsInDip(SimTime at) => bucket.IsInDip(at);

    /// <summary>Whether a datagram's fate is known as soon as it arrives: with drop-tail.</summary>
    public bool DecidesAtOnce => codel is null;

    /// <summary>When the next undecided datagram is decided; null if there is none. None of them leaves before.</summary>
    public SimTime? NextDecision => waiting.Count > 0 ? free : null;

    /// <summary>The number of datagrams dropped here, for lack of room or by CoDel.</summary>
    public long Dropped { get; private set; }

    /// <summary>The number of datagrams that have left or will leave.</summary>
    public long Passed { get; private set; }

    /// <summary>The bytes inside at a time, including overhead: the waiting datagrams and the one that leaves next.</summary>
    /// <param name="at">Not before the time of any earlier call.</param>
    public long BytesAt(SimTime at)
    {
        DecideUntil(at);
        while (leaving.TryPeek(out (int Bytes, SimTime At) first) && first.At <= at)
        {
            leaving.Dequeue();
            leavingBytes -= first.Bytes;
        }

        return leavingBytes + waiting.WaitingBytes;
    }

    /// <summary>
    /// Decides everything due up to and including that time, after the transfers through this queue have sent what they send until then.
    /// Afterwards nothing may arrive from before it.
    /// </summary>
    public void DecideUntil(SimTime now)
    {
        // A transfer that sends asks here which sender is next, so they come in order whichever runs first.
        foreach (BulkTransfer transfer in transfers)
        {
            transfer.RunUntil(now);
        }

        while (!idle && free <= now && codel is not null)
        {
            if (codel.TryDequeue(free, out CoDel.Waiting next))
            {
                next.Decided(Leave(free, next.Bytes));
            }
            else
            {
                idle = true;
            }
        }
    }

    /// <summary>Passes a datagram whose fate is decided at once; only for a queue with <see cref="DecidesAtOnce"/>.</summary>
    /// <param name="at">Not before the time of any earlier call.</param>
    /// <param name="bytes">Its own bytes, without overhead, 1 to <see cref="MaxBytes"/>.</param>
    /// <param name="leaves">When it leaves, if it does.</param>
    /// <returns>False if it is dropped.</returns>
    internal bool TryPass(SimTime at, int bytes, out SimTime leaves)
    {
        int onWire = bytes + Bottleneck.OverheadBytes;
        if (!HasRoom(at, onWire))
        {
            leaves = default;
            return false;
        }

        leaves = Leave(SimTime.Max(at, free), onWire);
        return true;
    }

    /// <summary>
    /// Passes a datagram, and notifies its sender of its fate as soon as that is decided: when it leaves, or null if it is dropped.
    /// </summary>
    internal void Pass(SimTime at, int bytes, Action<SimTime?> decided)
    {
        if (codel is null)
        {
            decided(TryPass(at, bytes, out SimTime leaves) ? leaves : null);
            return;
        }

        int onWire = bytes + Bottleneck.OverheadBytes;
        if (!HasRoom(at, onWire))
        {
            decided(null);
            return;
        }

        waiting.Add(new CoDel.Waiting(onWire, at, decided));
        free = SimTime.Max(free, idle ? at : free);
        idle = false;
        DecideUntil(at);
    }

    internal void Add(BulkTransfer transfer) => transfers.Add(transfer);

    internal void Remove(BulkTransfer transfer) => transfers.Remove(transfer);

    private bool HasRoom(SimTime at, int onWire)
    {
        long inside = BytesAt(at);
        if (at < lastCame)
        {
            throw new ArgumentOutOfRangeException(nameof(at), at.ToShortString(), $"A datagram already came at {lastCame.ToShortString()}; time only goes forward.");
        }

        lastCame = at;
        bool fits = inside + onWire <= Bottleneck.LimitBytes && (Bottleneck.BurstBytes == 0 || onWire <= Bottleneck.BurstBytes);
        Dropped += fits ? 0 : 1;
        return fits;
    }

    private SimTime Leave(SimTime from, int onWire)
    {
        free = bucket.Take(from, onWire);
        leaving.Enqueue((onWire, free));
        leavingBytes += onWire;
        Passed++;
        return free;
    }

    /// <summary>The undecided datagrams.</summary>
    private sealed class WaitingLine(LinkQueue queue) : CoDel.IWaitingLine
    {
        private readonly Queue<CoDel.Waiting> inside = new();

        public long WaitingBytes { get; private set; }

        internal int Count => inside.Count;

        public bool TryTakeFirst(out CoDel.Waiting first)
        {
            bool any = inside.TryDequeue(out first);
            WaitingBytes -= any ? first.Bytes : 0;
            return any;
        }

        public void Drop(CoDel.Waiting lost)
        {
            queue.Dropped++;
            lost.Decided(null);
        }

        internal void Add(CoDel.Waiting last)
        {
            inside.Enqueue(last);
            WaitingBytes += last.Bytes;
        }
    }
}
