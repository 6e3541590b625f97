using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A peer that joins a host's session, at its start or at any time later.</summary>
/// <remarks>
/// It sets its clock by the host's before its first tick, and fetches scene and committed state from it. Its own events show at once; one
/// that the host refuses is taken back. When it loses its host, or its world turns out to be wrong, it asks by itself to be let in again, as the same player, and
/// goes on from a fresh copy (<see cref="SessionState.Rejoining"/>). Its address may change at any time.
/// </remarks>
public sealed partial class JoinerSession : Session
{
    /// <summary>
    /// So many own events can wait for the host's verdict; <see cref="Session.Do"/> throws while they do. 16,384: at the rate that a host takes by default,
    /// more than half a minute without an answer.
    /// </summary>
    public const int MaxUnjudgedEvents = 1 << 14;

    /// <summary>By less than this a clock's estimate may be corrected on a bad link too.</summary>
    private static readonly SimDuration LeastJump = SimDuration.FromSeconds(1);

    private readonly PeerAddress host;
    private ulong nonce; // of the newest attempt
    private SimTime began = SimTime.MaxValue; // own clock, at the first step, later by as long as this machine slept: nobody was silent meanwhile
    private SimTime tended; // own clock, when this peer last looked after itself
    private SimTime awake = SimTime.MinValue; // own clock, when this machine last woke, if it slept
    private uint lastUrgent; // of the own events: the newest that nothing later makes up for
    private volatile object? pass; // a boxed one: other threads read it whole
    private bool isStartTold; // the host tells the start until it has heard that it is known here
    private uint logStart; // of the newest attempt
    private UpdateLink? link;
    private SimTime from = SimTime.MinValue; // the world goes on from there: earlier events are in it
    private uint firstSequence; // the last sequence number of those who had this peer's number before
    private OwnEvents unjudged = new(0);
    private ReceiveWindow incoming = new(0); // the host's log

    /// <summary>Asks to be let in, from the first step on.</summary>
    /// <param name="scene">The scene that the host is expected to have; null takes the host's, whichever it is.</param>
    /// <param name="port">What carries datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's own clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="host">Where the host is.</param>
    /// <param name="nonce">A number chosen at random; an answer must bear it.</param>
    public JoinerSession(Scene? scene, IDatagramPort port, IClock clock, SessionOptions options, PeerAddress host, ulong nonce)
        : base(scene, port, clock, options)
    {
        this.host = host;
        this.nonce = nonce;
        attempt = new JoinAttempt(nonce, Clock.Now);
        Pass = options.Pass.Number > 0 ? options.Pass : null;
        State = SessionState.Joining;
    }

    /// <summary>How late the host accepts an event, as it said; zero before it has.</summary>
    public SimDuration History { get; private set; }

    /// <summary>What is known of the distance between the two clocks.</summary>
    public ClockSync ClockSync { get; private set; } = new();

    /// <summary>
    /// What shows a host that this is the player it was, for another session of this program: see <see cref="SessionOptions.Pass"/>. Null before the host gave a
    /// number. From any thread.
    /// </summary>
    public PlayerPass? Pass
    {
        get => (PlayerPass?)pass;
        private set => pass = value;
    }

    /// <inheritdoc/>
    public override IReadOnlyList<LinkTraffic> Links => link is null ? Array.Empty<LinkTraffic>() : new[] { link.Traffic };

    /// <inheritdoc/>
    public override uint LogLength => incoming.Received;

    /// <summary>How many own events wait for the host's verdict, at most <see cref="MaxUnjudgedEvents"/>. On the session's thread.</summary>
    public int UnjudgedEvents => unjudged.Count;

    private protected override void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress sender)
    {
        if (sender != host || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            return;
        }

        switch (type)
        {
            case DatagramType.Challenge when IsWellFormed(ChallengeDatagram.TryDecode(datagram, out ChallengeDatagram challenge, out _)):
                OnChallenge(challenge);
                break;
            case DatagramType.Welcome when IsWellFormed(WelcomeDatagram.TryDecode(datagram, out WelcomeDatagram welcome, out _)):
                OnWelcome(welcome);
                break;
            case DatagramType.Refusal when IsWellFormed(RefusalDatagram.TryDecode(datagram, out RefusalDatagram refusal, out _)):
                OnRefusal(refusal.Nonce, refusal.Reason, Sentence(refusal.Reason));
                break;
            case DatagramType.Chunk when IsWellFormed(ChunkDatagram.TryDecode(datagram, out ChunkDatagram chunk, out _)):
                OnChunk(chunk, datagram.Length);
                break;
            case DatagramType.Evidence when IsWellFormed(EvidenceDatagram.TryDecode(datagram, out EvidenceDatagram evidence, out _)):
                OnEvidence(evidence, datagram.Length);
                break;
            case DatagramType.Leave when IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _)):
                OnLeave(leave);
                break;
            case DatagramType.Seat when IsWellFormed(SeatDatagram.TryDecode(datagram, out SeatDatagram seat, out _)):
                OnSeat(seat);
                break;
            case DatagramType.Knock or DatagramType.Join or DatagramType.Fetch or DatagramType.Doubt or DatagramType.Move:
                Counters.DatagramsIgnored++; // a joiner's own words
                break;
        }
    }

    private protected override void OnUpdate(UpdateDatagram update, PeerAddress sender)
    {
        if (link is null || sender != host || update.SessionId != link.SessionId || update.Peer != 0 || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            if (link is not null && sender == host && update.SessionId == link.SessionId && State == SessionState.Ended)
            {
                SayGoodbye(link, LeaveReason.Left); // it has not heard the first one
            }

            return;
        }

        SimTime now = Clock.Now;
        if (!link.Note(update, now, out bool isNewest))
        {
            Counters.DatagramsIgnored++;
            return;
        }

        link.CountReceived(update.EncodedLength);
        if (State == SessionState.Rejoining && attempt is not null && !attempt.IsWelcome)
        {
            Regain();
        }

        ClockSync clock = attempt?.Clock ?? ClockSync;
        bool isExchange = isNewest && link.TryGetSent(update.EchoNumber, out SimTime echoSent)
            && clock.Add(echoSent, update.EchoReceived, update.Sent, now) && clock.IsReady;
        if (isExchange && attempt is null)
        {
            SharedTime.Adjust(clock.Estimate);
            SimDuration off = SharedTime.Remaining < SimDuration.Zero ? -SharedTime.Remaining : SharedTime.Remaining;
            if (off > History && off > LeastJump && off > clock.Estimate.ErrorBound) // an exchange that waited long, in a stall, says little
            {
                // To bend it back at 5 % takes twenty times as long, and until then all that is done here would be refused.
                Rejoin(SessionEnd.Failed, FormattableString.Invariant(
                    $"This machine's clock and the host's are {off.ToSeconds():0.###} s further apart than before: one of them jumped, or the machine slept."), isLinkGood: false);
                return;
            }
        }

        if (IsOverdue(link.Silence(now)))
        {
            link.Hasten(now); // the host has not heard of this peer; it answers every update at once, so the other way is looked after
        }

        // Its clock is set first: events are late or not by it.
        isStartTold = update.Start != SimTime.MinValue;
        Keep(update); // in any case: the host hears that this update came, and does not send again what was in it
        if (attempt is not null)
        {
            TryBegin(update.Start);
            if (attempt is not null || State == SessionState.Ended)
            {
                return;
            }

            link.Hasten(now); // until the host hears that it has begun, it is told so again and again
        }

        link.Acknowledge(Math.Min(update.EventsReceived, LastSequence), now);
        long lost = Counters.EventsLost;
        if (!TakeEntries(now) && update.Held.Length > 0 && update.FirstIndex > incoming.Received)
        {
            link?.Answer(now); // what came before its turn is acknowledged too, else it goes again (RFC 9000, 13.2.1)
        }

        if (Counters.EventsLost > lost && PromisesAgreement)
        {
            Rejoin(SessionEnd.Failed, "An accepted event came too late for the history that this peer still had.", isLinkGood: false);
        }
        else
        {
            CompareCommitted(update);
        }
    }

    private protected override void Tend(SimTime now)
    {
        if (began == SimTime.MaxValue)
        {
            began = tended = now;
        }

        SimDuration slept = now - tended;
        if (slept > Options.Timeout / 2)
        {
            link?.NoteHeard(now); // it was this machine that slept, or whose clock jumped: who was not listened to was not silent
            rejoining += slept;
            began += slept;
            awake = now;
        }

        tended = now;
        if (State == SessionState.Rejoining)
        {
            TendRejoining(now);
        }
        else if (now - (link?.Heard ?? SimTime.Max(awake, SimTime.Max(began, attempt?.Began ?? began))) > Options.Timeout)
        {
            if (World is null)
            {
                AskAgainOrEnd(
                    now,
                    SessionEnd.HostSilent,
                    link is null ? NoAnswer(now) : Silence);
            }
            else
            {
                Rejoin(SessionEnd.HostSilent, Silence, isLinkGood: true);
            }
        }

        if (State == SessionState.Ended)
        {
            return;
        }

        if (attempt is JoinAttempt joining && !joining.IsWelcome)
        {
            if (joining.Due <= now)
            {
                AskToJoin(joining, now);
            }
        }
        else
        {
            TendFetch(now);
            TendInquiry(now);
            for (int n = 0; n < SendWindow.MaxDatagramsAtOnce && link?.IsDue(now) == true; n++)
            {
                SendUpdate(link, now);
            }
        }
    }

    /// <summary>How long one that is coming in, and is pushed out, asks again.</summary>
    private SimDuration LongestComing => Options.RejoinTime > Options.Timeout ? Options.RejoinTime : Options.Timeout;

    /// <summary>Names the longest of the times for which there was certainly no answer: who has a pass asks for more than the time-out.</summary>
    private string NoAnswer(SimTime now)
    {
        SimDuration asked = now - SimTime.Max(awake, SimTime.Max(began, attempt?.Began ?? began));
        SimDuration named = Options.Pass.Number > 0 && asked > Options.RejoinTime ? LongestComing : Options.Timeout;
        return FormattableString.Invariant($"No answer from {host} within {named.ToSeconds():0.###} s.");
    }

    private string Silence => FormattableString.Invariant($"The host at {host} fell silent for {Options.Timeout.ToSeconds():0.###} s.");

    private protected override SimTime NextDue(SimTime now) =>
        attempt is JoinAttempt joining && !joining.IsWelcome
            ? joining.Due
            : SimTime.Min(SimTime.Min(link?.Due ?? now, attempt?.Fetch?.Due ?? SimTime.MaxValue), inquiry?.Due ?? SimTime.MaxValue);

    private protected override void Publish(in ExternalEvent external)
    {
        unjudged.Add(external);
        lastUrgent = IsMadeUpFor(external) ? lastUrgent : external.Sequence;
        link!.NoteNews(UpdateDatagram.LengthOf(new UpdateEntry(Verdict.Pending, external)), Clock.Now);
    }

    private protected override void ThrowIfTooMuch()
    {
        if (unjudged.Count >= MaxUnjudgedEvents)
        {
            throw new InvalidOperationException(
                $"Nothing more can be done yet: {unjudged.Count} events of this peer wait for the host's verdict, and that is the most that may.");
        }
    }

    private protected override void Farewell()
    {
        for (int n = 0; link is not null && n < Goodbyes; n++)
        {
            SayGoodbye(link, LeaveReason.Left);
        }
    }

    private void OnLeave(in LeaveDatagram leave)
    {
        if (link is not null && leave.SessionId == link.SessionId && leave.Peer == 0)
        {
            string why = leave.Reason switch
            {
                LeaveReason.TimedOut => $"The host at {host} heard nothing from this peer for too long.",
                LeaveReason.Replaced => $"This player came in from elsewhere; the host at {host} let this peer go.",
                LeaveReason.NotJoined => $"The host at {host} does not have this peer among its joiners, or no longer.",
                LeaveReason.FellBehind => FormattableString.Invariant(
                    $"The link to the host at {host} is too slow: what happened {Options.Timeout.ToSeconds():0.###} s ago has not come over it yet."),
                LeaveReason.Kicked => $"The host at {host} sent this player away.",
                _ => $"The host at {host} ended the session.",
            };
            if (leave.Reason is not (LeaveReason.TimedOut or LeaveReason.NotJoined or LeaveReason.FellBehind))
            {
                End(leave.Reason == LeaveReason.HostEnded ? SessionEnd.HostEnded : leave.Reason == LeaveReason.Kicked ? SessionEnd.Kicked : SessionEnd.LetGo, why);
            }
            else if (State == SessionState.Rejoining)
            {
                attempt = attempt!.IsWelcome ? new JoinAttempt(NextNonce(), Clock.Now) : attempt;
                link = null; // what it was is over, or what it was about to be
            }
            else if (World is null && leave.Reason is LeaveReason.NotJoined or LeaveReason.TimedOut && attempt?.IsWelcome == true && Clock.Now - began <= LongestComing)
            {
                attempt = new JoinAttempt(NextNonce(), Clock.Now); // others who came in pushed it out, or it stood still, or the host is another one
                link = null;
                State = SessionState.Joining;
            }
            else if (World is null)
            {
                AskAgainOrEnd(Clock.Now, SessionEnd.LetGo, why);
            }
            else
            {
                Rejoin(leave.Reason == LeaveReason.FellBehind ? SessionEnd.LinkTooSlow : SessionEnd.LetGo, why, isLinkGood: false);
            }
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    private void Keep(UpdateDatagram update)
    {
        uint number = update.FirstIndex;
        foreach (UpdateEntry entry in update.Held)
        {
            incoming.Put(number++, entry); // what is too far ahead comes again
        }

        if (update.Watermark != SimTime.MinValue && number > 0)
        {
            incoming.Promise(number - 1, update.Watermark);
        }
    }

    /// <summary>Takes what has come, in order; false if there is nothing.</summary>
    private bool TakeEntries(SimTime now)
    {
        bool any = incoming.HasNext;
        bool isUrgent = false;
        while (incoming.HasNext)
        {
            UpdateEntry entry = incoming.Take();
            isUrgent |= entry.IsOwn ? entry.Sequence <= lastUrgent || entry.Verdict != Verdict.Accepted : !IsMadeUpFor(entry.Event);
            Take(entry);
        }

        if (incoming.Promised != SimTime.MinValue)
        {
            // What is not judged yet, or still to be done, may have to be taken back, and for that its history must be there. Own stamps
            // never go back. That the host has an event is not enough: an older update may come between that and its verdict.
            SimTime needed = unjudged.Count > 0 ? unjudged.Oldest.Time : SharedTime.Now;
            Commit(SimTime.Min(incoming.Promised, needed));
        }

        if (!any || link is null) // what was committed may have differed: then this peer has left the link for a fresh copy
        {
            return any;
        }

        if (isUrgent)
        {
            link.Answer(now);
        }
        else
        {
            link.Hasten(now + UpdateLink.MostAckDelay);
        }

        return true;
    }

    private void Take(in UpdateEntry entry)
    {
        bool own = entry.IsOwn;
        ExternalEvent external = entry.Event;
        bool isAnothers = !own && (external.Peer != Peer || external.Sequence <= firstSequence);
        bool isNextOwn = own && unjudged.Count > 0 && unjudged.Oldest.Sequence == entry.Sequence;
        if (!isAnothers && !isNextOwn)
        {
            Counters.EventsForged++; // a host that judges what this peer did not do, or not in order, is none of ours
            return;
        }

        if (own)
        {
            external = unjudged.Take();
            link!.Acknowledge(external.Sequence, Clock.Now); // an update that was overtaken may tell the verdict first
        }

        bool accepted = entry.Verdict == Verdict.Accepted && (own || MayEnter(external));
        IsWithoutEffect = !accepted;
        Counters.EventsAccepted += accepted ? 1 : 0;
        Counters.EventsRefused += accepted ? 0 : 1;
        if (own && !accepted)
        {
            Counters.EventsLost += World!.Retract(external) ? 0 : 1;
            Limits.TakeBack(external);
        }
        else if (!own && accepted && external.Time >= from)
        {
            Limits.Note(external);
            Apply(external);
        }

        Tell(new LogEntry(incoming.Received, entry.Verdict, external));
    }

    private void SendUpdate(UpdateLink to, SimTime now)
    {
        UpdateDatagram update = to.Compose(now);
        update.EventsReceived = attempt is null ? incoming.Received : 0;
        update.Ready = attempt is null || attempt.IsReady;
        update.Start = attempt is null && isStartTold ? World!.Simulation.Start : SimTime.MinValue;
        to.Fill(unjudged, now);
        bool isComingIn = attempt is not null && !(attempt.Seat is not null && World is null);
        SimDuration pace = to.Trips.Mean / 8 > JoinAttempt.Pace ? to.Trips.Mean / 8 : JoinAttempt.Pace;
        SimDuration rest = isComingIn ? pace : RestAfterUpdate(to, false, now, Options.KeepAlive);
        Send(to.Seal(unjudged, now, rest, isUrgent: to.Outgoing.Acknowledged < lastUrgent), to);
    }
}
