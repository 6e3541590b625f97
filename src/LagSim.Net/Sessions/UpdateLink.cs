using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>One end of the exchange of updates with one other peer: what came, what is on its way, and when the next one is due.</summary>
/// <remarks>
/// What is new goes at once, and what is not acknowledged again each resend interval, as far as the link's <see cref="SpareRate"/> allows. Beyond that nothing is repeated
/// before it is known to be lost, and what is new waits until it is worth a datagram: two thirds of its bytes are entries, or half of what it will wait in the
/// queue, or a tenth of a second, has passed. No more is on its way than <see cref="CongestionControl"/> lets, but for two probes into a silence.
/// </remarks>
internal sealed class UpdateLink
{
    /// <summary>So long the acknowledgement of what is not urgent may wait for a datagram that goes out anyway.</summary>
    internal static readonly SimDuration MostAckDelay = SimDuration.FromMilliseconds(100);

    /// <summary>What an update has beside its entries, in bytes: header, state hash, UDP and IP.</summary>
    private const int OwnBytes = WireFormat.EmptyUpdateBytes + WireFormat.StateHashBytes + CongestionControl.DatagramOverhead;

    /// <summary>The longest wait for an answer doubles no more often than this.</summary>
    private const int MostDoublings = 3;

    /// <summary>So many times in a row nothing is answered before the link counts as another one.</summary>
    private const int Silent = 3;

    /// <summary>Who writes more often is not answered more often than this, in the mean.</summary>
    private static readonly SimDuration LeastDistance = SimDuration.FromMilliseconds(1);

    /// <summary>
    /// By so many of its distances may what is hastened be ahead: after a pause three go out at once. What one player does then does not wait because an answer to what
    /// another did has just gone.
    /// </summary>
    private const int MostAhead = 2;

    /// <summary>A window's worth of datagrams goes out in four fifths of a round trip, so that it does not overflow a short queue at once (RFC 9002, 7.7).</summary>
    private const double PaceGain = 1.25;

    /// <summary>How long an answer is waited for before a round trip has been measured.</summary>
    private static readonly SimDuration FirstPatience = SimDuration.FromMilliseconds(300);

    private readonly SimDuration interval;
    private readonly UpdateDatagram outgoing;
    private readonly byte[] buffer;
    private readonly SessionFault fault;
    private readonly SeenNumbers seen = new();
    private readonly SentDatagrams sent = new();
    private readonly CongestionControl congestion;
    private readonly SpareRate spare;
    private readonly RoundTrips trips = new();
    private uint lastSent;
    private SimTime echoReceived = SimTime.MinValue;
    private SimDuration unheard;
    private SimTime paced = SimTime.MinValue; // when the next update would be due if all kept their distance
    private SimDuration distance = LeastDistance; // of the last
    private SimTime latest = SimTime.MinValue; // when the last update was sent
    private int atOnce; // how many were sent then
    private SimTime newsSince = SimTime.MaxValue; // since when something new waits
    private int newsBytes; // how much, in entries
    private int unanswered; // how many times in a row answers were overdue
    private SimTime answered; // when something was answered, or began to be waited for
    private uint echoed; // the newest number that a round trip was taken of
    private bool isProbe; // the next update goes whatever the window
    private bool isHeldBack; // something has to go and may not yet
    private long datagramsSent;
    private long bytesSent;
    private long datagramsReceived;
    private long bytesReceived;

    /// <param name="sessionId">What every datagram of this link bears.</param>
    /// <param name="self">This peer's number.</param>
    /// <param name="peer">The other's.</param>
    /// <param name="other">Where that is.</param>
    /// <param name="acknowledged">The other has this peer's entries up to this one.</param>
    /// <param name="interval">How long what is not acknowledged waits before it is repeated, where there is room.</param>
    /// <param name="outgoing">What updates are composed in, one after the other; all links of a session share it.</param>
    /// <param name="buffer">Where their bytes go; likewise.</param>
    /// <param name="now">By the own clock.</param>
    /// <param name="fault">What is done wrong on purpose.</param>
    internal UpdateLink(
        ulong sessionId, byte self, byte peer, PeerAddress other, uint acknowledged, SimDuration interval, UpdateDatagram outgoing, byte[] buffer, SimTime now,
        SessionFault fault = SessionFault.None)
    {
        this.outgoing = outgoing;
        this.buffer = buffer;
        SessionId = sessionId;
        Self = self;
        Peer = peer;
        Other = other;
        this.fault = fault;
        Outgoing = new SendWindow(acknowledged, fault);
        congestion = new CongestionControl(fault);
        spare = new SpareRate(fault);
        this.interval = interval;
        Heard = now;
        Due = now;
    }

    internal ulong SessionId { get; }

    /// <summary>This peer's number; 0 also for a joiner that has none yet.</summary>
    internal byte Self { get; set; }

    /// <summary>The other's number; 0 also for a joiner that has none yet.</summary>
    internal byte Peer { get; set; }

    /// <summary>Where the other is.</summary>
    internal PeerAddress Other { get; set; }

    /// <summary>What of this peer's entries goes out next.</summary>
    internal SendWindow Outgoing { get; private set; }

    internal LinkTraffic Traffic => new(Peer, Other, datagramsSent, bytesSent, datagramsReceived, bytesReceived, trips.Newest, trips.HasQueue ? trips.Queueing : SimDuration.Zero);

    /// <summary>What is known of the round trips.</summary>
    internal RoundTrips Trips => trips;

    /// <summary>When the last update came, by the own clock.</summary>
    internal SimTime Heard { get; private set; }

    /// <summary>When the next update is due, by the own clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>How long an answer is waited for.</summary>
    private SimDuration Patience => (trips.IsMeasured ? trips.Patience : FirstPatience) + MostAckDelay + interval;

    private SimDuration LongestTrip => trips.Mean > trips.Newest ? trips.Mean : trips.Newest;

    /// <summary>
    /// How long something new waits for more at most, where it may not hurry: no longer than an answer takes, and no longer than the queue itself has it wait, but
    /// for what nobody notices on such a link.
    /// </summary>
    private SimDuration MergeTime
    {
        get
        {
            SimDuration most = trips.Queueing / 2 > MostAckDelay ? trips.Queueing / 2 : MostAckDelay;
            return trips.Mean < most ? trips.Mean : most;
        }
    }

    /// <summary>The longer of two silences: for how long nothing came, and for how long the other said, when it last wrote, that nothing came there.</summary>
    internal SimDuration Silence(SimTime now) => now - Heard > unheard ? now - Heard : unheard;

    /// <summary>Begins anew with entries after that number, before any was sent.</summary>
    internal void StartAfter(uint acknowledged) => Outgoing = new SendWindow(acknowledged, fault);

    /// <summary>When an update was sent that the other says it has; false for one that was not, or long ago.</summary>
    internal bool TryGetSent(uint number, out SimTime at) => sent.TryGetTime(number, out at);

    /// <summary>Notes an update that came.</summary>
    /// <param name="update">The update.</param>
    /// <param name="now">When it came, by the own clock.</param>
    /// <param name="isNewest">False for one that was overtaken: of it only entries, watermark and acknowledgement are news.</param>
    /// <returns>False for one that came before, or is so old that it may have.</returns>
    internal bool Note(UpdateDatagram update, SimTime now, out bool isNewest)
    {
        isNewest = update.Number > seen.Newest;
        if (!seen.Add(update.Number))
        {
            return false; // perhaps somebody plays it again: it does not even show that the other is there
        }

        if (isNewest)
        {
            Heard = now;
            echoReceived = now;
            SimDuration held = update.EchoNumber == 0 ? SimDuration.Zero : update.Sent - update.EchoReceived; // both by its own clock
            unheard = held;
            bool isNewTrip = update.EchoNumber > echoed || (fault & SessionFault.CountsTripsAgain) != 0; // else its way there has counted
            if (isNewTrip && sent.TryGetTime(update.EchoNumber, out SimTime at)
                && held >= SimDuration.Zero && held <= now - at) // else it is made up
            {
                trips.Add(now - at - held, now);
                echoed = update.EchoNumber;
            }
        }

        TakeAcknowledgements(update, now);
        return true;
    }

    /// <summary>Notes that the other has this peer's entries up to a number.</summary>
    internal void Acknowledge(uint number, SimTime now)
    {
        Outgoing.Acknowledge(number);
        while (sent.TryTakeCovered(Outgoing.Acknowledged, out SentDatagrams.Datagram covered))
        {
            congestion.OnAcknowledged(covered.Bytes, trips.HasQueue);
            (unanswered, answered) = (0, now);
        }

        if (isHeldBack && congestion.HasRoom)
        {
            Hasten(now);
        }
    }

    /// <summary>Notes something else that only the other can have sent, and only now.</summary>
    internal void NoteHeard(SimTime now) => Heard = now;

    /// <summary>Has the next update sent no later than this, unless so many went out just now that the least distance would not be kept in the mean.</summary>
    internal void Hasten(SimTime by) => Due = SimTime.Min(Due, SimTime.Max(by, paced == SimTime.MinValue ? by : paced - (distance * MostAhead)));

    /// <summary>Has the other answered: at once, or where that is too much together with what else there is to say soon.</summary>
    internal void Answer(SimTime now) => Hasten(MayHurry(now) ? now : now + MostAckDelay);

    /// <summary>Notes that there is something new for the other, of that many bytes.</summary>
    internal void NoteNews(int bytes, SimTime now)
    {
        newsBytes += bytes;
        newsSince = SimTime.Min(newsSince, now);
        if (congestion.HasRoom) // else it goes with what is acknowledged, or lost, next
        {
            Hasten(newsBytes >= 2 * OwnBytes || MayHurry(now) ? now : newsSince + MergeTime);
        }

        isHeldBack |= !congestion.HasRoom;
    }

    internal void CountReceived(int bytes)
    {
        datagramsReceived++;
        bytesReceived += bytes;
    }

    internal void CountSent(int bytes)
    {
        datagramsSent++;
        bytesSent += bytes;
    }

    /// <summary>Whether an update is due; what was not answered for too long counts as lost from now on.</summary>
    internal bool IsDue(SimTime now)
    {
        if (Due > now)
        {
            return false;
        }

        TakeLost(now);
        if (sent.Waited > 0 && now >= AnswerDue(now))
        {
            unanswered = Math.Min(unanswered + 1, MostDoublings + Silent);
            if (unanswered == Silent && trips.HasQueue)
            {
                congestion.OnSilence(now);
            }

            // With a queue on the way the answer is more likely late than lost. So twice only the oldest goes again, as a probe that the window does not hold back
            // (RFC 9002, 6.2.4 and 7.5); then all that is overdue is lost, and what goes is what the least window lets (7.6).
            SimTime before = now - Patience;
            isProbe = trips.HasQueue && unanswered < Silent;
            while (sent.TryPeekOldest(out SimTime at) && at <= before && sent.TryTakeOldest(out SentDatagrams.Datagram oldest))
            {
                Lose(oldest, now, hasQueue: false);
                if (isProbe)
                {
                    break;
                }
            }
        }

        return true;
    }

    /// <summary>An update with everything that this type knows filled in; the rest is the caller's. Then <see cref="Fill"/>, and send it with <see cref="Seal"/>.</summary>
    internal UpdateDatagram Compose(SimTime now)
    {
        outgoing.Clear();
        outgoing.SessionId = SessionId;
        outgoing.Peer = Self;
        outgoing.Number = ++lastSent;
        outgoing.Sent = now;
        outgoing.EchoNumber = seen.Newest;
        outgoing.EchoBits = seen.BitsBefore(seen.Newest);
        outgoing.EchoReceived = echoReceived;
        return outgoing;
    }

    /// <summary>Puts entries into the composed update.</summary>
    internal void Fill(IEntrySource source, SimTime now)
    {
        spare.Advance(now, trips, unanswered > 0, Doublings(now));
        if (!congestion.HasRoom && !isProbe)
        {
            outgoing.FirstIndex = Outgoing.Sent + 1;
            return;
        }

        isProbe = false;

        // What has to go finds the window half empty. An update that is worth its own bytes is none that could have waited.
        int repeated = Outgoing.Fill(outgoing, source, congestion.IsHalfFull ? 0 : spare.Bytes, OwnBytes, congestion.DatagramBytes - OwnBytes);
        int needed = outgoing.EncodedLength - WireFormat.EmptyUpdateBytes - repeated;
        spare.Spend(repeated + Math.Max(0, OwnBytes - (Math.Max(0, needed) / 2)));
    }

    /// <summary>The bytes of the composed update; sets when the next is due.</summary>
    /// <param name="source">The entries.</param>
    /// <param name="now">When it is sent.</param>
    /// <param name="rest">How long nothing is sent where nothing is the matter.</param>
    /// <param name="isUrgent">Whether something is not acknowledged that nothing later makes up for.</param>
    internal ReadOnlySpan<byte> Seal(IEntrySource source, SimTime now, SimDuration rest, bool isUrgent)
    {
        int length = outgoing.Encode(buffer);
        answered = sent.Waited == 0 && unanswered == 0 ? now : answered;
        uint last = outgoing.FirstIndex + (uint)outgoing.Held.Length - 1;
        if (sent.Add(lastSent, now, length + CongestionControl.DatagramOverhead, outgoing.FirstIndex, last) is SentDatagrams.Datagram forgotten)
        {
            Lose(forgotten, now, trips.HasQueue);
        }

        if (outgoing.Held.Length > 0)
        {
            congestion.OnSent(length + CongestionControl.DatagramOverhead);
        }

        bool hasNeeded = Outgoing.HasNeeded(source);
        isHeldBack = hasNeeded && !congestion.HasRoom;
        if (!hasNeeded)
        {
            (newsBytes, newsSince) = (0, SimTime.MaxValue);
        }

        distance = outgoing.Held.Length > 0 ? Distance(length) : LeastDistance;
        bool isPaced = distance > LeastDistance;
        paced = now == latest && !isPaced ? paced : SimTime.Max(paced, now) + distance; // those of one moment count as one, where there is room
        atOnce = now == latest ? atOnce + 1 : 1;
        latest = now;
        Due = !hasNeeded || isHeldBack ? now + (rest > LeastDistance ? rest : LeastDistance)
            : isPaced ? SimTime.Max(now, paced - (distance * MostAhead))
            : atOnce < SendWindow.MaxDatagramsAtOnce ? now
            : now + LeastDistance;
        if (sent.Waited > 0)
        {
            Hasten(AnswerDue(now));
            if (sent.TryGetOvertaken(out SimTime at))
            {
                Hasten(at + LongestTrip + (LongestTrip / 8));
            }

            if ((isUrgent || Outgoing.HasLost) && !congestion.IsHalfFull)
            {
                SimDuration affordable = spare.WaitFor(OwnBytes + Outgoing.RepetitionBytes(source));
                Hasten(now + (interval > affordable ? interval : affordable));
            }
        }

        return buffer.AsSpan(0, length);
    }

    /// <summary>How far apart updates with entries go in the mean, by their length.</summary>
    private SimDuration Distance(int length)
    {
        SimDuration even = SimDuration.FromSeconds(trips.Mean.ToSeconds() * (length + CongestionControl.DatagramOverhead) / (PaceGain * congestion.Window));
        return trips.IsMeasured && even > LeastDistance ? even : LeastDistance;
    }

    /// <summary>When the answer to what was sent is overdue.</summary>
    private SimTime AnswerDue(SimTime now) => sent.TryPeekOldest(out SimTime at) ? at + (Patience * (1L << Doublings(now))) : SimTime.MaxValue;

    /// <summary>
    /// How many times the wait for an answer has doubled. Where there is a queue it doubles each time that an answer was overdue. Where there is none it first does
    /// after eight times the wait, since a link that loses several datagrams in a row is lost for longer the fewer are sent; by then nobody may be there.
    /// </summary>
    private int Doublings(SimTime now)
    {
        int doublings = 0;
        while (doublings < MostDoublings && doublings < unanswered && (trips.HasQueue || now - answered > Patience * (8L << doublings)))
        {
            doublings++;
        }

        return doublings;
    }

    /// <summary>Whether an update may go for little.</summary>
    private bool MayHurry(SimTime now)
    {
        spare.Advance(now, trips, unanswered > 0, Doublings(now));
        return spare.WaitFor(OwnBytes) == SimDuration.Zero;
    }

    private void TakeAcknowledgements(UpdateDatagram update, SimTime now)
    {
        AcknowledgeUpdate(update.EchoNumber, now);
        for (int n = 0; n < 32 && update.EchoBits >> n != 0; n++)
        {
            if ((update.EchoBits >> n & 1) != 0)
            {
                AcknowledgeUpdate(update.EchoNumber - 1 - (uint)n, now);
            }
        }

        TakeLost(now);
        if (Outgoing.HasToGoAgain || (isHeldBack && congestion.HasRoom))
        {
            Hasten(now);
        }
    }

    private void AcknowledgeUpdate(uint number, SimTime now)
    {
        if (sent.TryAcknowledge(number, out SentDatagrams.Datagram came))
        {
            congestion.OnAcknowledged(came.Bytes, trips.HasQueue);
            (unanswered, answered) = (0, now);
        }
    }

    private void TakeLost(SimTime now)
    {
        while (sent.TryTakeLost(now, LongestTrip, out SentDatagrams.Datagram datagram))
        {
            Lose(datagram, now, trips.HasQueue);
        }
    }

    private void Lose(in SentDatagrams.Datagram datagram, SimTime now, bool hasQueue)
    {
        if (congestion.OnLost(datagram.Bytes, datagram.At, now, hasQueue) && trips.HasQueue)
        {
            spare.Cut(); // where none shows, repetition is what hides losses
        }

        sent.NoteLost(datagram);
        Outgoing.Lose(datagram.First, datagram.Last, isOnItsWay: sent.IsCarriedLater(datagram, datagram.First, datagram.Last));
    }
}
