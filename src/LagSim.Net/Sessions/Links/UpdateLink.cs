using System;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Links;

/// <summary>One end of the exchange of updates with one other peer: what came, what is on its way, and when the next one is due.</summary>
/// <remarks>
/// What is new goes at once, and what is not acknowledged again each resend interval, as far as the link's <see cref="SpareRate"/> allows.
/// Beyond that nothing is repeated
/// before it is known to be lost, and what is new waits until it is worth a datagram: two thirds of its bytes are entries, or half of what
/// it will wait in the
/// queue, or a tenth of a second, has passed. No more is on its way than <see cref="CongestionControl"/> lets, but for two probes into a
/// silence.
/// </remarks>
internal sealed class UpdateLink
{
    /// <summary>So long the acknowledgement of what is not urgent may wait for a datagram that goes out anyway.</summary>
    internal static readonly SimDuration MostAckDelay = SimDuration.FromMilliseconds(100);

    /// <summary>What an update has beside its entries, in bytes: header, state hash, UDP and IP.</summary>
    private const int OwnBytes = WireFormat.EmptyUpdateBytes + WireFormat.StateHashBytes + CongestionControl.DatagramOverhead;

    /// <summary>
    /// A window's worth of datagrams goes out in four fifths of a round trip, so that it does not overflow a short queue at once (RFC 9002,
    /// 7.7).
    /// </summary>
    private const double PaceGain = 1.25;

    private readonly SimDuration interval;
    private readonly LinkEnds ends;
    private readonly UpdateComposer composer;
    private readonly LinkHearing hearing;
    private readonly LinkFlight flight;
    private readonly AnswerTimer answers;
    private readonly SpareRate spare;
    private readonly SendPacer pacer;
    private readonly LinkTrafficCounter traffic = new();
    private readonly UnsentEntries unsent = new();
    private bool isProbe; // the next update goes whatever the window
    private bool isHeldBack; // something has to go and may not yet

    /// <param name="sessionId">What every datagram of this link bears.</param>
    /// <param name="self">This peer's number.</param>
    /// <param name="peer">The other's.</param>
    /// <param name="other">Where that is.</param>
    /// <param name="acknowledged">The other has this peer's entries up to this one.</param>
    /// <param name="interval">How long what is not acknowledged waits before it is repeated, where there is room.</param>
    /// <param name="outgoing">What updates are composed in, one after the other; all links of a session share it.</param>
    /// <param name="buffer">Where their bytes go; likewise.</param>
    /// <param name="now">By the own clock.</param>
    /// <param name="parts">What its parts are made by; null for the usual ones.</param>
    internal UpdateLink(
        ulong sessionId, byte self, byte peer, PeerAddress other, uint acknowledged, SimDuration interval, UpdateDatagram outgoing,
        byte[] buffer, SimTime now, LinkParts? parts = null)
    {
        this.interval = interval;
        parts ??= new LinkParts();
        ends = new LinkEnds(sessionId, self, peer, other);
        composer = new UpdateComposer(outgoing, buffer);
        hearing = parts.Hearing(now);
        pacer = new SendPacer(now);
        spare = parts.Spare();
        SentDatagrams sent = new();
        answers = new AnswerTimer(Trips, sent, MostAckDelay + interval);
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

    /// <summary>Where the other is.</summary>
    internal PeerAddress Other
    {
        get => ends.Other;
        set => ends.Other = value;
    }

    /// <summary>What of this peer's entries goes out next.</summary>
    internal SendWindow Outgoing => flight.Window;

    internal LinkTraffic Traffic => traffic.Of(Peer, Other, Trips);

    /// <summary>What is known of the round trips.</summary>
    internal RoundTrips Trips { get; } = new();

    /// <summary>When the last update came, by the own clock.</summary>
    internal SimTime Heard => hearing.Heard;

    /// <summary>When the next update is due, by the own clock.</summary>
    internal SimTime Due => pacer.Due;

    /// <summary>
    /// How long something new waits for more at most, where it may not hurry: no longer than an answer takes, and no longer than the queue
    /// itself has it wait, but
    /// for what nobody notices on such a link.
    /// </summary>
    private SimDuration MergeTime
    {
        get
        {
            SimDuration most = Trips.Queueing / 2 > MostAckDelay ? Trips.Queueing / 2 : MostAckDelay;
            return Trips.Mean < most ? Trips.Mean : most;
        }
    }

    /// <summary>
    /// The longer of two silences: for how long nothing came, and for how long the other said, when it last wrote, that nothing came there.
    /// </summary>
    internal SimDuration Silence(SimTime now) => hearing.Silence(now);

    /// <summary>When an update was sent that the other says it has; false for one that was not, or long ago.</summary>
    internal bool TryGetSent(uint number, out SimTime at) => flight.Sent.TryGetTime(number, out at);

    /// <summary>Notes an update that came.</summary>
    /// <param name="update">The update.</param>
    /// <param name="now">When it came, by the own clock.</param>
    /// <param name="isNewest">False for one that was overtaken: of it only entries, watermark and acknowledgement are new.</param>
    /// <returns>False for one that came before, or is so old that it may have.</returns>
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

    /// <summary>Notes that the other has this peer's entries up to a number.</summary>
    internal void Acknowledge(uint number, SimTime now)
    {
        flight.Acknowledge(number, now);
        if (isHeldBack && flight.Congestion.HasRoom)
        {
            Flush(now);
        }
    }

    /// <summary>Notes something else that only the other can have sent, and only now.</summary>
    internal void NoteHeard(SimTime now) => hearing.NoteHeard(now);

    /// <summary>
    /// Has the next update sent no later than this, unless so many went out just now that the least distance would not be kept in the mean.
    /// </summary>
    internal void Flush(SimTime by) => pacer.Flush(by);

    /// <summary>Has the other answered: at once, or where that is too much together with what else there is to say soon.</summary>
    internal void Answer(SimTime now) => Flush(MayHurry(now) ? now : now + MostAckDelay);

    /// <summary>Notes that there is something new for the other, of that many bytes.</summary>
    internal void NoteLateEvent(int bytes, SimTime now)
    {
        unsent.Note(bytes, now);
        if (flight.Congestion.HasRoom) // else it goes with what is acknowledged, or lost, next
        {
            Flush(unsent.Bytes >= 2 * OwnBytes || MayHurry(now) ? now : unsent.Since + MergeTime);
        }

        isHeldBack |= !flight.Congestion.HasRoom;
    }

    internal void CountReceived(int bytes) => traffic.CountReceived(bytes);

    internal void CountSent(int bytes) => traffic.CountSent(bytes);

    /// <summary>Whether an update is due; what was not answered for too long counts as lost from now on.</summary>
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
    /// An update with everything that this type knows filled in; the rest is the caller's. Then <see cref="Fill"/>, and send it with <see
    /// cref="Seal"/>.
    /// </summary>
    internal UpdateDatagram Compose(SimTime now) => composer.Next(SessionId, Self, hearing, now);

    /// <summary>Puts entries into the composed update.</summary>
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

        // What has to go finds the window half empty. An update that is worth its own bytes is none that could have waited.
        int most = congestion.IsHalfFull ? 0 : spare.Bytes;
        int repeated = Outgoing.Fill(update, source, most, OwnBytes, congestion.DatagramBytes - OwnBytes);
        int needed = update.EncodedLength - WireFormat.EmptyUpdateBytes - repeated;
        spare.Spend(repeated + Math.Max(0, OwnBytes - (Math.Max(0, needed) / 2)));
    }

    /// <summary>The bytes of the composed update; sets when the next is due.</summary>
    /// <param name="source">The entries.</param>
    /// <param name="now">When it is sent.</param>
    /// <param name="rest">How long nothing is sent where nothing is the matter.</param>
    /// <param name="isUrgent">Whether something is not acknowledged that nothing later makes up for.</param>
    internal ReadOnlySpan<byte> Seal(IEntrySource source, SimTime now, SimDuration rest, bool isUrgent)
    {
        UpdateDatagram update = composer.Update;
        ReadOnlySpan<byte> bytes = composer.Encode();
        flight.NoteSent(update, bytes.Length, now);
        bool hasNeeded = Outgoing.HasNeeded(source);
        isHeldBack = hasNeeded && !flight.Congestion.HasRoom;
        if (!hasNeeded)
        {
            unsent.Clear();
        }

        pacer.NoteSent(now, update.Held.Length > 0 ? Distance(bytes.Length) : SendPacer.LeastDistance);
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

    /// <summary>Has the next update sent when an answer is overdue, something counts as lost, or what is urgent may be repeated.</summary>
    private void FlushForAnswers(IEntrySource source, SimTime now, bool isUrgent)
    {
        Flush(answers.Due(now));
        if (flight.Sent.TryGetOvertaken(out SimTime at))
        {
            Flush(at + flight.LongestTrip + (flight.LongestTrip / 8));
        }

        if ((isUrgent || Outgoing.HasLost) && !flight.Congestion.IsHalfFull)
        {
            SimDuration affordable = spare.WaitFor(OwnBytes + Outgoing.RepetitionBytes(source));
            Flush(now + (interval > affordable ? interval : affordable));
        }
    }

    /// <summary>How far apart updates with entries go in the mean, by their length.</summary>
    private SimDuration Distance(int length)
    {
        SimDuration even = SimDuration.FromSeconds(
            Trips.Mean.ToSeconds() * (length + CongestionControl.DatagramOverhead) / (PaceGain * flight.Congestion.Window));
        return Trips.IsMeasured && even > SendPacer.LeastDistance ? even : SendPacer.LeastDistance;
    }

    /// <summary>Whether an update may go for little.</summary>
    private bool MayHurry(SimTime now)
    {
        spare.Advance(now, Trips, answers.IsOverdue, answers.Doublings(now));
        return spare.WaitFor(OwnBytes) == SimDuration.Zero;
    }
}
