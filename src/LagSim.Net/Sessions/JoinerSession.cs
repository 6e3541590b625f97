using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>A peer that joins a host's session, at its start or at any time later.</summary>
/// <remarks>
/// It sets its clock by the host's before its first tick, and fetches scene and committed state from it. Its own events show at once; one
/// that the host refuses is taken back. After a time-out it joins again as a new one.
/// </remarks>
public sealed partial class JoinerSession : Session
{
    /// <summary>
    /// So many own events can wait for the host's verdict; <see cref="Session.Do"/> throws while they do. 16,384: at the rate that a host takes by default,
    /// more than half a minute without an answer.
    /// </summary>
    public const int MaxUnjudgedEvents = 1 << 14;

    /// <summary>How long between two tries to be let in, and between two exchanges while the clock is set.</summary>
    private static readonly SimDuration Pace = SimDuration.FromMilliseconds(20);

    /// <summary>By less than this a clock's estimate may be corrected on a bad link too.</summary>
    private static readonly SimDuration LeastJump = SimDuration.FromSeconds(1);

    private readonly PeerAddress host;
    private readonly ulong nonce;
    private readonly SimTime began;
    private SimTime tended; // own clock, when this peer last looked after itself
    private uint lastUrgent; // of the own events: the newest that nothing later makes up for
    private UpdateLink? link;
    private SimTime joinDue;
    private SimTime from = SimTime.MinValue; // the world goes on from there: earlier events are in it
    private uint firstSequence; // the last sequence number of those who had this peer's number before
    private OwnEvents unjudged = new(0);
    private SendWindow outgoing = new(0); // what the host has of own events; their verdicts may come later
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
        began = Clock.Now;
        tended = began;
        joinDue = began;
        State = SessionState.Joining;
    }

    /// <summary>How late the host accepts an event, as it said; zero before it has.</summary>
    public SimDuration History { get; private set; }

    /// <summary>What is known of the distance between the two clocks.</summary>
    public ClockSync ClockSync { get; } = new();

    /// <inheritdoc/>
    public override IReadOnlyList<LinkTraffic> Links => link is null ? Array.Empty<LinkTraffic>() : new[] { link.Traffic };

    /// <inheritdoc/>
    public override uint LogLength => incoming.Received;

    /// <summary>How many own events wait for the host's verdict, at most <see cref="MaxUnjudgedEvents"/>. On the session's thread.</summary>
    public int UnjudgedEvents => unjudged.Count;

    private bool IsReady => copy is not null && SharedTime.IsSet;

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
                OnRefusal(refusal.Nonce, Sentence(refusal.Reason));
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
            case DatagramType.Knock or DatagramType.Join or DatagramType.Fetch or DatagramType.Doubt:
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
        if (isNewest && update.EchoSent != SimTime.MinValue
            && ClockSync.Add(update.EchoSent, update.EchoReceived, update.Sent, now) && ClockSync.IsReady)
        {
            SharedTime.Adjust(ClockSync.Estimate);
            SimDuration off = SharedTime.Remaining < SimDuration.Zero ? -SharedTime.Remaining : SharedTime.Remaining;
            if (World is not null && off > History && off > LeastJump)
            {
                // To bend it back at 5 % takes twenty times as long, and until then all that is done here would be refused.
                Farewell();
                End(SessionEnd.Failed, FormattableString.Invariant(
                    $"This machine's clock and the host's are {off.ToSeconds():0.###} s further apart than before: one of them jumped, or the machine slept.")
                    + " Join again.");
                return;
            }
        }

        if (IsOverdue(link.Silence(now)))
        {
            link.Hasten(now); // the host has not heard of this peer; it answers every update at once, so the other way is looked after
        }

        // Its clock is set first: events are late or not by it.
        bool hadWorld = World is not null;
        TryBegin(update.Start);
        if (!hadWorld && World is not null)
        {
            link.Hasten(now); // until the host hears that it has begun, it is told so again and again
        }

        if (World is not null)
        {
            outgoing.Acknowledge(Math.Min(update.EventsReceived, LastSequence));
            TakeEntries(update, now);
            if (update.HasStateHash)
            {
                CompareCommitted(update.HashTime, update.StateHash);
            }
        }
    }

    private protected override void Tend(SimTime now)
    {
        if (now - tended > Options.Timeout / 2)
        {
            link?.NoteHeard(now); // it was this machine that slept, or whose clock jumped: who was not listened to was not silent
        }

        tended = now;
        SimTime heard = link?.Heard ?? began;
        if (now - heard > Options.Timeout)
        {
            End(SessionEnd.HostSilent, link is null
                ? FormattableString.Invariant($"No answer from {host} within {Options.Timeout.ToSeconds():0.###} s.")
                : FormattableString.Invariant($"The host at {host} fell silent for {Options.Timeout.ToSeconds():0.###} s."));
            return;
        }

        if (link is null)
        {
            if (joinDue <= now)
            {
                AskToJoin(now);
                joinDue = now + Pace;
            }

            return;
        }

        TendFetch(now);
        TendInquiry(now);
        if (link.Due <= now)
        {
            bool hasMore = true;
            for (int n = 0; hasMore && n < SendWindow.MaxDatagramsAtOnce; n++)
            {
                hasMore = SendUpdate(link, now);
            }
        }
    }

    private protected override SimTime NextDue(SimTime now) =>
        link is null ? joinDue : SimTime.Min(SimTime.Min(link.Due, fetch?.Due ?? SimTime.MaxValue), inquiry?.Due ?? SimTime.MaxValue);

    private protected override void Publish(in ExternalEvent external)
    {
        unjudged.Add(external);
        lastUrgent = IsMadeUpFor(external) ? lastUrgent : external.Sequence;
        link!.Hasten(Clock.Now);
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
            End(leave.Reason == LeaveReason.HostEnded ? SessionEnd.HostEnded : SessionEnd.LetGo, leave.Reason switch
            {
                LeaveReason.TimedOut => $"The host at {host} heard nothing from this peer for too long.",
                LeaveReason.Replaced => $"This player came in from elsewhere; the host at {host} let this peer go.",
                LeaveReason.NotJoined => $"The host at {host} does not have this peer among its joiners, or no longer.",
                LeaveReason.FellBehind => $"The host at {host} let this peer go: it did not take in what happened as fast as it did.",
                _ => $"The host at {host} ended the session.",
            });
        }
        else
        {
            Counters.DatagramsIgnored++;
        }
    }

    /// <summary>Makes the world once scene, state or start, and the shared time are there.</summary>
    private void TryBegin(SimTime start)
    {
        if (!IsReady)
        {
            return;
        }

        State = State == SessionState.Synchronising ? SessionState.Waiting : State;
        if (World is not null)
        {
            return;
        }

        if (copy!.Snapshot is not WorldSnapshot snapshot)
        {
            if (start != SimTime.MinValue && start < EarliestStart())
            {
                Farewell();
                End(SessionEnd.Failed, FormattableString.Invariant(
                    $"The host at {host} says that the session began {(SharedTime.Now - start).ToSeconds():0} s ago and sent no state of it: that is more than")
                    + " history and time-out allow.");
            }
            else if (start != SimTime.MinValue)
            {
                Begin(start);
            }

            return;
        }

        try
        {
            from = snapshot.Time;
            Begin(snapshot);
        }
        catch (SceneException failure)
        {
            Farewell();
            End(SessionEnd.Failed, $"The state that the host at {host} sent is no world of its scene. {failure.Message}");
        }
    }

    /// <summary>
    /// Whoever joins later than the history after the start gets a state with the scene. The start of one who got none lies at most the history before it
    /// asked to be let in, and the time-out for clocks and copies; before that nothing is simulated, however long it would take.
    /// </summary>
    private SimTime EarliestStart() =>
        SharedTime.Now - (Clock.Now - began) - Options.Timeout
        - (History < LatencyCompensationWindow.MaxHistory ? History : LatencyCompensationWindow.MaxHistory);

    private void TakeEntries(UpdateDatagram update, SimTime now)
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

        if (any)
        {
            link!.Hasten(isUrgent ? now : now + MostAckDelay);
        }
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
            outgoing.Acknowledge(external.Sequence); // an update that was overtaken may tell the verdict first
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

    /// <summary>Sends one update; whether there is more to be sent at once.</summary>
    private bool SendUpdate(UpdateLink to, SimTime now)
    {
        UpdateDatagram update = to.Compose(now);
        update.EventsReceived = incoming.Received;
        update.Ready = IsReady;
        update.Start = World?.Simulation.Start ?? SimTime.MinValue;
        bool hasMore = outgoing.Fill(update, unjudged, now, TimesOf(to));
        SimDuration wait = !IsReady
            ? Pace
            : WaitAfterUpdate(outgoing.Acknowledged < lastUrgent || outgoing.HasLost, outgoing.Acknowledged < LastSequence, to, now, Options.KeepAlive);
        Send(to.Seal(hasMore ? now : now + wait), to);
        return hasMore;
    }
}
