using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>
/// A TCP connection that sends without end, in virtual time: a download that takes whatever a bottleneck gives and fills its queue.
/// </summary>
/// <remarks>
/// <para>NewReno: slow start, congestion avoidance, fast retransmit, limited transmit (RFC 5681, 3042), fast recovery with partial
/// acknowledgements in the impatient variant (RFC 6582), and the retransmission timer of RFC 6298 on the round trip that every
/// acknowledgement carries (RFC 7323). The window begins with ten segments (RFC 6928). The receiver acknowledges each segment at once and
/// has room for <see cref="ReceiveWindow"/>. No handshake, no end, no selective acknowledgements: after many losses at once it recovers
/// more slowly than today's systems do.</para>
/// <para>It is part of the queues that it goes through: a sender through one of them finds it in its state at that time. So it need not be
/// stepped; <see cref="RunUntil"/> is for reading figures. All senders that share a queue must act in the order of time.</para>
/// <para>Deterministic: integers, and the random draws of its links. Some 250 steps per second of time at 1 Mbit/s. Not thread-safe.</para>
/// </remarks>
internal sealed class BulkTransfer
{
    /// <summary>
    /// The payload of a segment in bytes: an Ethernet frame's 1,500 without the headers of IPv4 and of TCP with timestamps.
    /// </summary>
    public const int SegmentBytes = 1_448;

    /// <summary>The most bytes sent and not acknowledged.</summary>
    public const int ReceiveWindow = 4 << 20;

    /// <summary>
    /// The size passed to <see cref="LinkModel.Send(SimTime, int)"/> for a segment, so that with the overhead of UDP it is 1,514 bytes on
    /// the wire.
    /// </summary>
    internal const int SegmentDatagramBytes = SegmentBytes + AckDatagramBytes;

    /// <summary>
    /// The size passed for an acknowledgement, which is 66 bytes on the wire: TCP's header with timestamps is 24 bytes longer than UDP's.
    /// </summary>
    internal const int AckDatagramBytes = 24;

    private const long InitialWindow = 10 * SegmentBytes;
    private const int DuplicatesThatTellALoss = 3;

    private static readonly SimDuration MinTimeout = SimDuration.FromSeconds(1);
    private static readonly SimDuration MaxTimeout = SimDuration.FromSeconds(60);

    private readonly LinkModel data;
    private readonly LinkModel acks;
    private readonly PriorityQueue<Arrival, (SimTime Time, long Sequence)> arrivals = new();
    private readonly HashSet<long> early = []; // segments that arrived before a missing one
    private long sequence;
    private bool isRunning;
    private bool isStopped;
    private bool isStarted;

    // Segments are counted from 0. The receiver has all below received.
    private long received;
    private long unacknowledged;
    private long next;
    private long highest; // one past the highest ever sent
    private long recover = -1; // one past the highest sent when a loss was last detected
    private long window = InitialWindow;
    private long threshold = ReceiveWindow;
    private int duplicates;
    private bool isRecovering;
    private bool hadPartial;
    private SimTime? timeout;
    private SimDuration timeoutAfter = MinTimeout;
    private SimDuration? smoothed;
    private SimDuration variation;

    /// <summary>Creates a transfer that begins at a time.</summary>
    /// <param name="data">The direction of the segments; it has a queue.</param>
    /// <param name="acks">The direction of the acknowledgements.</param>
    /// <param name="start">When it begins.</param>
    internal BulkTransfer(LinkModel data, LinkModel acks, SimTime start)
    {
        this.data = data;
        this.acks = acks;
        Start = start;
        if (data.Queue is null)
        {
            throw new ArgumentException("A bulk transfer needs a bottleneck on its way; nothing else would hold it back.", nameof(data));
        }

        data.Queue.Add(this);
        acks.Queue?.Add(this);
    }

    /// <summary>When it began.</summary>
    public SimTime Start { get; }

    /// <summary>The number of bytes that the receiver has without gaps, as of the time up to which it has run.</summary>
    public long ReceivedBytes => received * SegmentBytes;

    /// <summary>The number of segments sent, retransmissions included.</summary>
    public long SegmentsSent { get; private set; }

    /// <summary>The number of retransmissions.</summary>
    public long SegmentsSentAgain { get; private set; }

    /// <summary>How often the retransmission timer expired.</summary>
    public long Timeouts { get; private set; }

    /// <summary>When it acts next; null once it is stopped.</summary>
    internal SimTime? NextEvent
    {
        get
        {
            if (isStopped)
            {
                return null;
            }

            if (!isStarted)
            {
                return Start;
            }

            SimTime? first = timeout;
            first = arrivals.TryPeek(out _, out (SimTime Time, long Sequence) due) && !(first <= due.Time) ? due.Time : first;
            return Decision is SimTime decision && !(first <= decision) ? decision : first;
        }
    }

    private long InFlight => (next - unacknowledged) * SegmentBytes;

    private SimTime? Decision
    {
        get
        {
            SimTime? one = data.Queue!.NextDecision, other = acks.Queue?.NextDecision;
            return other is null || one <= other ? one : other;
        }
    }

    /// <summary>The rate of new data at the receiver since the start, in bit/s of the segments' own bytes.</summary>
    /// <param name="now">A time after <see cref="Start"/>; it is run until then.</param>
    public double GoodputBitsPerSecond(SimTime now)
    {
        if (now <= Start)
        {
            throw new ArgumentOutOfRangeException(nameof(now), now.ToShortString(), $"The transfer begins at {Start.ToShortString()}; a rate can be told only after that.");
        }

        RunUntil(now);
        return ReceivedBytes * 8 / (now - Start).ToSeconds();
    }

    /// <summary>Runs up to and including that time. Afterwards no datagram from before it may be sent through one of its queues.</summary>
    public void RunUntil(SimTime now)
    {
        if (isRunning)
        {
            return; // already sending, and a queue asks which sender is next
        }

        isRunning = true;
        while (NextEvent is SimTime then && then <= now)
        {
            Step(then);
        }

        isRunning = false;
    }

    /// <summary>Stops it; its segments in the queues stay there.</summary>
    internal void Stop()
    {
        isStopped = true;
        data.Queue!.Remove(this);
        acks.Queue?.Remove(this);
    }

    private void Step(SimTime now)
    {
        if (!isStarted)
        {
            isStarted = true;
            SendWhatMay(now);
        }
        else if (Decision <= now)
        {
            data.Queue!.DecideUntil(now);
            acks.Queue?.DecideUntil(now);
        }
        else if (arrivals.TryPeek(out Arrival arrival, out (SimTime Time, long Sequence) due) && due.Time <= now)
        {
            arrivals.Dequeue();
            if (arrival.IsAck)
            {
                TakeAck(now, arrival.Segment, arrival.Sent);
            }
            else
            {
                TakeSegment(now, arrival);
            }
        }
        else
        {
            TimeOut(now);
        }
    }

    /// <summary>The receiver's side.</summary>
    private void TakeSegment(SimTime now, Arrival segment)
    {
        if (segment.Segment == received)
        {
            received++;
            while (early.Remove(received))
            {
                received++;
            }
        }
        else if (segment.Segment > received)
        {
            early.Add(segment.Segment);
        }

        Send(now, acks, AckDatagramBytes, new Arrival(true, received, segment.Sent));
    }

    private void TakeAck(SimTime now, long upTo, SimTime echo)
    {
        if (upTo > unacknowledged)
        {
            Measure(now - echo);
            long bytes = (upTo - unacknowledged) * SegmentBytes;
            unacknowledged = upTo;
            next = Math.Max(next, upTo);
            duplicates = 0;
            bool restarts = true;
            if (!isRecovering)
            {
                window += window < threshold ? Math.Min(bytes, SegmentBytes) : Math.Max(1, (long)SegmentBytes * SegmentBytes / window);
            }
            else if (upTo >= recover)
            {
                isRecovering = false;
                window = Math.Min(threshold, Math.Max(InFlight, SegmentBytes) + SegmentBytes);
            }
            else
            {
                // Another of the segments sent before the loss was detected is missing.
                window = Math.Max(window - bytes + SegmentBytes, SegmentBytes);
                restarts = !hadPartial;
                hadPartial = true;
                SendSegment(now, unacknowledged);
            }

            timeout = InFlight == 0 ? null : restarts ? now + timeoutAfter : timeout;
        }
        else if (upTo == unacknowledged && InFlight > 0)
        {
            duplicates++;
            if (isRecovering)
            {
                window += SegmentBytes;
            }
            else if (duplicates == DuplicatesThatTellALoss && unacknowledged > recover)
            {
                threshold = HalfOfFlight();
                window = threshold + (DuplicatesThatTellALoss * SegmentBytes);
                recover = next;
                isRecovering = true;
                hadPartial = false;
                SendSegment(now, unacknowledged);
                timeout = now + timeoutAfter;
            }
        }

        SendWhatMay(now);
    }

    private void TimeOut(SimTime now)
    {
        Timeouts++;
        threshold = HalfOfFlight();
        window = SegmentBytes;
        timeoutAfter = timeoutAfter > MaxTimeout / 2 ? MaxTimeout : timeoutAfter * 2;
        recover = highest;
        isRecovering = false;
        duplicates = 0;
        next = unacknowledged;
        timeout = null;
        SendWhatMay(now);
    }

    private long HalfOfFlight() => Math.Max(InFlight / 2, 2 * SegmentBytes);

    /// <summary>RFC 6298, section 2.</summary>
    private void Measure(SimDuration roundTrip)
    {
        if (smoothed is SimDuration before)
        {
            SimDuration off = before > roundTrip ? before - roundTrip : roundTrip - before;
            variation = ((variation * 3) + off) / 4;
            smoothed = ((before * 7) + roundTrip) / 8;
        }
        else
        {
            smoothed = roundTrip;
            variation = roundTrip / 2;
        }

        SimDuration wanted = smoothed.Value + (variation * 4);
        timeoutAfter = wanted < MinTimeout ? MinTimeout : wanted > MaxTimeout ? MaxTimeout : wanted;
    }

    private void SendWhatMay(SimTime now)
    {
        int limited = isRecovering ? 0 : Math.Min(duplicates, DuplicatesThatTellALoss - 1);
        long may = Math.Min(window + (limited * SegmentBytes), ReceiveWindow);
        while (InFlight + SegmentBytes <= may)
        {
            SendSegment(now, next++);
        }
    }

    private void SendSegment(SimTime now, long segment)
    {
        SegmentsSent++;
        SegmentsSentAgain += segment < highest ? 1 : 0;
        highest = Math.Max(highest, segment + 1);
        timeout ??= now + timeoutAfter;
        Send(now, data, SegmentDatagramBytes, new Arrival(false, segment, now));
    }

    private void Send(SimTime now, LinkModel way, int bytes, Arrival arrival) => way.Send(now, bytes, deliveries =>
    {
        for (int i = 0; i < deliveries.Count; i++)
        {
            arrivals.Enqueue(arrival, (deliveries[i], sequence++));
        }
    });

    /// <summary>A segment or an acknowledgement in transit.</summary>
    /// <param name="IsAck">Whether it is an acknowledgement.</param>
    /// <param name="Segment">The segment, or the one below which the receiver has all.</param>
    /// <param name="Sent">When the segment was sent; for an acknowledgement, the segment that it answers.</param>
    private readonly record struct Arrival(bool IsAck, long Segment, SimTime Sent);
}
