using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A <see cref="Links.Bottleneck"/> at work: a queue, and the line behind it. Several directions may go through one and the same.
/// </summary>
/// <remarks>
/// <para>First in, first out. With drop-tail a datagram's fate is known when it comes, since it depends on nothing that comes later. With
/// CoDel it is not: what is lost at the head depends on how much waits behind it by then. So it is decided when it is next, and who sent it
/// is told then (<see cref="NextDecision"/>, <see cref="DecideUntil"/>): as RFC 8289 has it, nothing is guessed.</para>
/// <para>The next is chosen when the one before it has left, and is then served by the token bucket. It counts as waiting until it leaves
/// for the room there is, not for CoDel; both as in the kernel.</para>
/// <para>Deterministic: the same datagrams at the same times have the same fates; the only luck is where a dip's period begins. Not
/// thread-safe.</para>
/// </remarks>
internal sealed class LinkQueue
{
    /// <summary>A UDP datagram has no more bytes of its own.</summary>
    internal const int MaxBytes = 65_507;

    private readonly TokenBucket bucket;
    private readonly CoDel? codel;
    private readonly WaitingLine waiting;
    private readonly Queue<(int Bytes, SimTime At)> leaving = new(); // decided, not gone yet
    private readonly List<BulkTransfer> transfers = []; // those that go through here, and send by themselves
    private long leavingBytes;
    private SimTime lastCame = SimTime.MinValue;
    private SimTime free = SimTime.MinValue; // when the last that was decided has left
    private bool idle = true; // nothing came since then; CoDel knows it

    /// <summary>An empty queue whose line has been idle.</summary>
    /// <param name="bottleneck">What it is.</param>
    /// <param name="path">
    /// The luck of a path, on which it depends where a dip's period begins; only <see cref="SeededRandom.Fork"/> is called on it. Default:
    /// one begins at time zero.
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

    /// <summary>What it is.</summary>
    public Bottleneck Bottleneck { get; }

    /// <summary>Whether the line is in a dip at that time.</summary>
    public bool IsInDip(SimTime at) => bucket.IsInDip(at);

    /// <summary>Whether a datagram's fate is known as soon as it comes: with drop-tail.</summary>
    public bool DecidesAtOnce => codel is null;

    /// <summary>When the next of those that wait undecided is decided; null when none does. None of them leaves before.</summary>
    public SimTime? NextDecision => waiting.Count > 0 ? free : null;

    /// <summary>How many datagrams were lost here, for want of room or by CoDel.</summary>
    public long Dropped { get; private set; }

    /// <summary>How many datagrams have left or are decided to.</summary>
    public long Passed { get; private set; }

    /// <summary>The bytes inside at a time, their overhead included: what waits and what is next to leave.</summary>
    /// <param name="at">Not before the time of any call before.</param>
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
    /// Decides all that is to be decided by then, that time included, once the transfers that go through here have sent what they send
    /// until then. Nothing may come from before it afterwards.
    /// </summary>
    public void DecideUntil(SimTime now)
    {
        // One that sends asks here who comes before it, so they come in order whichever is first.
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

    /// <summary>A datagram comes, and its fate is known; only of a queue that <see cref="DecidesAtOnce"/>.</summary>
    /// <param name="at">Not before the time of any call before.</param>
    /// <param name="bytes">Its own bytes, without overhead, 1 to <see cref="MaxBytes"/>.</param>
    /// <param name="leaves">When it leaves, if it does.</param>
    /// <returns>False if it is lost.</returns>
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
    /// A datagram comes, and whoever sent it is told its fate as soon as it is decided: when it leaves, or null if it is lost.
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

    /// <summary>What waits undecided.</summary>
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
