using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>One end of the exchange of updates with another peer: what arrived, what is in flight, and when the next one is due.</summary>
/// <remarks>
/// New entries are sent at once, but no more often than a display shows them: what comes up in a sixtieth of a second goes together. Each
/// goes in as many updates as the losses ask for (<see cref="EntryCopies"/>), as far as the link's <see cref="SpareRate"/> allows. Beyond
/// that nothing is repeated before it is known to be lost, and new entries wait until they are worth a datagram: two thirds of its
/// bytes are entries, or half the time that it will wait in the queue has passed, or a tenth of a second. <see cref="CongestionControl"/>
/// limits the bytes in flight, except for two probes into a silence.
/// </remarks>
internal sealed class UpdateLink
{
    /// <summary>How long an acknowledgement that is not urgent may wait for a datagram that goes out anyway.</summary>
    internal static readonly SimDuration MaxAckDelay = SimDuration.FromMilliseconds(100);

    /// <summary>How long an acknowledgement of events waits for a datagram that goes out anyway: two of a busy link.</summary>
    internal static readonly SimDuration AnswerDelay = SendPacer.Together * 2;

    /// <summary>The bytes of an update besides its entries, without protection: header, state hash, UDP and IP.</summary>
    private const int PlainOwnBytes = WireFormat.EmptyUpdateBytes + WireFormat.StateHashBytes + CongestionControl.DatagramOverhead;

    /// <summary>
    /// The pacing gain: a window of datagrams is spread over four fifths of a round trip, so that it does not overflow a short queue at
    /// once (RFC 9002, 7.7).
    /// </summary>
    private const double PaceGain = 1.25;

    private readonly SimDuration interval;
    private readonly LinkEnds ends;
    private readonly UpdateComposer composer;
    private readonly LinkReceipts hearing;
    private readonly LinkFlight flight;
    private readonly AnswerTimer answers;
    private readonly SpareRate spare;
    private readonly SendPacer pacer;
    private readonly LinkTrafficCounter traffic = new();
    private readonly UnsentEntries unsent = new();
    private bool isProbe; // the next update is sent whatever the window
    private bool isHeldBack; // something has to be sent and may not yet

    /// <param name="ends">The two ends of the link.</param>
    /// <param name="acknowledged">The last of this peer's entries that the other has without a gap.</param>
    /// <param name="interval">How long entries wait before they go again for lack of new ones, where losses ask for it and there is room.</param>
    /// <param name="outgoing">The update to compose in, one at a time; shared by all links of a session.</param>
    /// <param name="buffer">The buffer to encode into; shared likewise.</param>
    /// <param name="now">The time by the local clock.</param>
    /// <param name="parts">The factory of its parts; null for the usual ones.</param>
    /// <param name="bytesPerSecond">The most bytes of updates a second, UDP and IP headers included, in the mean.</param>
    internal UpdateLink(
        LinkEnds ends, uint acknowledged, SimDuration interval, UpdateDatagram outgoing, byte[] buffer, SimTime now,
        LinkParts? parts = null, double bytesPerSecond = double.PositiveInfinity)
    {
        this.interval = interval;
        parts ??= new LinkParts();
        this.ends = ends;
        composer = new UpdateComposer(outgoing, buffer);
        hearing = parts.Hearing(now);
        pacer = new SendPacer(now, bytesPerSecond);
        spare = parts.Spare();
        SentDatagrams sent = new();
        answers = new AnswerTimer(Trips, sent, MaxAckDelay + interval);
        flight = new LinkFlight(parts.Window(acknowledged), sent, parts.Congestion(), Trips, spare, answers);
    }

    internal ulong SessionId => ends.SessionId;

    /// <summary>This peer's number; 0 also for a client that has none yet.</summary>
    internal byte Self
    {
        get => ends.Self;
        set => ends.Self = value;
    }

    /// <summary>The other's number; 0 also for a client that has none yet.</summary>
    internal byte Peer
    {
        get => ends.Peer;
        set => ends.Peer = value;
    }

    /// <summary>The other's address.</summary>
    internal PeerAddress Other
    {
        get => ends.Other;
        set => ends.Other = value;
    }

    /// <summary>Seals the link's datagrams; null in a session without protection.</summary>
    internal LinkSeal? Seal => ends.Seal;

    /// <summary>Chooses which of this peer's entries are sent next.</summary>
    internal SendWindow Outgoing => flight.Window;

    /// <summary>How long a datagram may be.</summary>
    internal PathSize Path => flight.Path;

    internal LinkTraffic Traffic => traffic.Of(Peer, Other, Trips);

    /// <summary>The measured round trips.</summary>
    internal RoundTrips Trips { get; } = new();

    /// <summary>When the last update arrived, by the local clock.</summary>
    internal SimTime Heard => hearing.Heard;

    /// <summary>When the next update is due, by the local clock.</summary>
    internal SimTime Due => pacer.Due;

    /// <summary>Whether an answer to entries that were sent is awaited.</summary>
    internal bool IsAwaiting => flight.Sent.Waited > 0;

    /// <summary>The bytes of an update besides its entries.</summary>
    private int OwnBytes => PlainOwnBytes + ends.SealBytes;

    /// <summary>
    /// How long a new entry waits at most for more, where it may not hurry: no longer than an answer takes, and no longer than its delay in
    /// the queue, unless that is too short to notice on such a link.
    /// </summary>
    private SimDuration MergeTime
    {
        get
        {
            SimDuration most = Trips.Queueing / 2 > MaxAckDelay ? Trips.Queueing / 2 : MaxAckDelay;
            return Trips.Mean < most ? Trips.Mean : most;
        }
    }

    /// <summary>
    /// The longer of two silences: since anything arrived here, and since anything arrived at the other end, as it last reported.
    /// </summary>
    internal SimDuration Silence(SimTime now) => hearing.Silence(now);

    /// <summary>Looks up when an acknowledged update was sent; false for one that was not sent, or too long ago.</summary>
    internal bool TryGetSent(uint number, out SimTime at) => flight.Sent.TryGetTime(number, out at);

    /// <summary>Records an update that arrived.</summary>
    /// <param name="update">The update.</param>
    /// <param name="now">When it arrived, by the local clock.</param>
    /// <param name="isNewest">False for one that was overtaken: only its entries, watermark and acknowledgement are new.</param>
    /// <returns>False for one that arrived before, or is so old that it may have.</returns>
    internal bool Note(UpdateDatagram update, SimTime now, out bool isNewest)
    {
        if (!hearing.Note(update, now, flight.Sent, Trips, out isNewest))
        {
            return false;
        }

        flight.TakeAcknowledgements(update, now);
        if (Outgoing.HasToGoAgain || (isHeldBack && flight.Congestion.HasRoom))
        {
            Flush(now);
        }

        return true;
    }

    /// <summary>Records that the other has this peer's entries up to a number.</summary>
    internal void Acknowledge(uint number, SimTime now)
    {
        flight.Acknowledge(number, now);
        if (isHeldBack && flight.Congestion.HasRoom)
        {
            Flush(now);
        }
    }

    /// <summary>Records another datagram that only the other end can have sent, and only now.</summary>
    internal void NoteHeard(SimTime now) => hearing.NoteHeard(now);

    /// <summary>
    /// Sends the next update no later than this, unless so many went out just now that the average distance would fall below the least.
    /// </summary>
    internal void Flush(SimTime by) => pacer.Flush(by);

    /// <summary>Answers the other end: at once, or, where that is too much, soon, together with whatever else is to be sent.</summary>
    internal void Answer(SimTime now) => Flush(MayHurry(now) ? now : now + MaxAckDelay);

    /// <summary>Acknowledges events: together with what else is to be sent, and soon.</summary>
    internal void AnswerSoon(SimTime now) => Flush(now + (MayHurry(now) ? AnswerDelay : MaxAckDelay));

    /// <summary>Records a new entry for the other end, of that many bytes.</summary>
    internal void NoteNewEntry(int bytes, SimTime now)
    {
        unsent.Note(bytes, now);
        if (flight.Congestion.HasRoom) // otherwise it is sent when something is next acknowledged or lost
        {
            Flush(unsent.Bytes >= 2 * OwnBytes || MayHurry(now) ? now : unsent.Since + MergeTime);
        }

        isHeldBack |= !flight.Congestion.HasRoom;
    }

    /// <summary>Counts a datagram that arrived, by its length without a seal.</summary>
    internal void CountReceived(int bytes) => traffic.CountReceived(bytes + ends.SealBytes);

    /// <summary>Counts a datagram that was sent, by its length on the link.</summary>
    internal void CountSent(int bytes) => traffic.CountSent(bytes);

    /// <summary>Whether an update is due; what has been unanswered for too long counts as lost from now on.</summary>
    internal bool IsDue(SimTime now)
    {
        if (Due > now)
        {
            return false;
        }

        flight.TakeLost(now);
        if (flight.Sent.Waited > 0 && now >= answers.Due(now))
        {
            isProbe = flight.TakeOverdue(now);
        }

        return true;
    }

    /// <summary>
    /// Begins an update with everything filled in that this type knows; the rest is the caller's. Then call <see cref="Fill"/>, and send it
    /// with <see cref="Complete"/>.
    /// </summary>
    internal UpdateDatagram Compose(SimTime now) => composer.Next(SessionId, Self, hearing, now);

    /// <summary>Adds entries to the composed update.</summary>
    internal void Fill(IEntrySource source, SimTime now)
    {
        UpdateDatagram update = composer.Update;
        CongestionControl congestion = flight.Congestion;
        spare.Advance(now, Trips, answers.IsOverdue, answers.Doublings(now));
        if (!congestion.HasRoom && !isProbe)
        {
            update.FirstIndex = Outgoing.Sent + 1;
            return;
        }

        isProbe = false;

        // What has to be sent must find the window half empty. An update worth its own bytes is not optional traffic.
        int most = congestion.IsHalfFull || pacer.IsPressed(now) ? 0 : spare.Bytes;
        int longest = answers.IsOverdue ? PathSize.LeastUpdateRoom : Path.UpdateRoom; // perhaps long ones do not arrive
        int repeated = Outgoing.Fill(update, source, most, OwnBytes, Math.Min(congestion.DatagramBytes - OwnBytes, longest), flight.Copies);
        int needed = update.EncodedLength - WireFormat.EmptyUpdateBytes - repeated;
        spare.Spend(repeated + Math.Max(0, OwnBytes - (Math.Max(0, needed) / 2)));
    }

    /// <summary>Returns the bytes of the composed update, and sets when the next is due.</summary>
    /// <param name="source">The entries.</param>
    /// <param name="now">When it is sent.</param>
    /// <param name="rest">The pause when nothing is wrong.</param>
    /// <param name="isUrgent">Whether something unacknowledged is not superseded by anything later.</param>
    internal ReadOnlySpan<byte> Complete(IEntrySource source, SimTime now, SimDuration rest, bool isUrgent)
    {
        UpdateDatagram update = composer.Update;
        ReadOnlySpan<byte> bytes = composer.Encode();
        flight.NoteSent(update, bytes.Length + ends.SealBytes, now);
        bool hasNeeded = Outgoing.HasNeeded(source);
        isHeldBack = hasNeeded && !flight.Congestion.HasRoom;
        if (!hasNeeded)
        {
            unsent.Clear();
        }

        int length = bytes.Length + ends.SealBytes;
        pacer.NoteSent(
            now, Distance(update.Held.Length > 0 ? length : 0, isFull: hasNeeded), length + CongestionControl.DatagramOverhead);
        if (hasNeeded && !isHeldBack)
        {
            pacer.GoOn(now);
        }
        else
        {
            pacer.Rest(now, rest);
        }

        if (flight.Sent.Waited > 0)
        {
            FlushForAnswers(source, now, isUrgent);
        }

        return bytes;
    }

    /// <summary>
    /// Schedules the next update for when an answer is overdue, something counts as lost, or urgent entries may be repeated.
    /// </summary>
    private void FlushForAnswers(IEntrySource source, SimTime now, bool isUrgent)
    {
        Flush(answers.Due(now));
        if (flight.Sent.TryGetOvertaken(out SimTime at))
        {
            Flush(at + flight.LongestTrip + (flight.LongestTrip / 8));
        }

        int copies = flight.Copies;
        if ((isUrgent || Outgoing.HasLost) && Outgoing.HasCopiesLeft(copies) && !flight.Congestion.IsHalfFull)
        {
            SimDuration affordable = spare.WaitFor(OwnBytes + Outgoing.RepetitionBytes(source, copies));
            SimDuration wanted = flight.RepeatDelay(interval);
            Flush(now + (wanted > affordable ? wanted : affordable));
        }
    }

    /// <summary>The average distance to the next update.</summary>
    /// <param name="length">The length of one with entries; 0 for one without, which the window does not count.</param>
    /// <param name="isFull">Whether more had to go than it could carry.</param>
    private SimDuration Distance(int length, bool isFull)
    {
        SimDuration least = isFull ? SendPacer.MinDistance : SendPacer.Together;
        if (length == 0 || !Trips.IsMeasured)
        {
            return least;
        }

        SimDuration even = SimDuration.FromSeconds(
            Trips.Mean.ToSeconds() * (length + CongestionControl.DatagramOverhead) / (PaceGain * flight.Congestion.Window));
        return even > least ? even : least;
    }

    /// <summary>Whether an update may be sent for little.</summary>
    private bool MayHurry(SimTime now)
    {
        spare.Advance(now, Trips, answers.IsOverdue, answers.Doublings(now));
        return spare.WaitFor(OwnBytes) == SimDuration.Zero;
    }
}
