using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>The peer that others join. It alone says yes or no to each event, once, and keeps the log in which all verdicts stand in order.</summary>
/// <remarks>
/// Its clock is the session's. The watermark, before which it accepts nothing, follows that clock, so a silent joiner stalls nobody. It plays
/// itself, by <see cref="Session.Do"/>, or only serves. It keeps nothing of who has not shown, by a cookie, that it is where it says.
/// </remarks>
public sealed partial class HostSession : Session
{
    /// <summary>A joiner that has not taken in so many lines of the log is told to go.</summary>
    private const int MaxUnacknowledged = 1 << 16;

    private readonly VerdictLog log = new();
    private readonly LogView logView;
    private readonly List<Joiner> joiners = new();
    private readonly uint[] lastSequences = new uint[SessionOptions.MaxJoiners + 1]; // by number: of the last event that bears it
    private readonly ulong sessionId;
    private ulong joins;
    private uint lastUrgent; // of the log: the newest entry that nothing later makes up for

    /// <summary>Opens a session and waits for joiners.</summary>
    /// <param name="scene">The scene that all share.</param>
    /// <param name="port">What carries datagrams; not disposed with the session.</param>
    /// <param name="clock">This machine's own clock.</param>
    /// <param name="options">How to take part.</param>
    /// <param name="sessionId">
    /// A number that no other session on these machines has; choose it at random. From it and a secret of this host each join gets a session id that nobody
    /// else can tell: it goes with every datagram, and what is still on its way from or to a former joiner is not taken for that of a later one.
    /// </param>
    public HostSession(Scene scene, IDatagramPort port, IClock clock, SessionOptions options, ulong sessionId)
        : base(scene ?? throw new ArgumentNullException(nameof(scene)), port, clock, options)
    {
        this.sessionId = sessionId;
        logView = new LogView(log);
        cookies = new JoinCookies();
        sceneCopy = WorldCopy.Encode(scene, null);
        SharedTime.Adjust(SimDuration.Zero);
        State = SessionState.Waiting;
    }

    /// <summary>
    /// Raised on the session's thread for each joiner that was let in, which then fetches scene and state, with its link. Handlers must not throw.
    /// </summary>
    public event Action<LinkTraffic>? JoinerCame;

    /// <summary>
    /// Raised on the session's thread, once, for each joiner that left, fell silent, was told to go, or came anew from the same address, with what went over
    /// its link in all. Not for those who are there when the session ends. Handlers must not throw.
    /// </summary>
    public event Action<LinkTraffic>? JoinerGone;

    /// <summary>How many joiners there are now.</summary>
    public int JoinerCount => joiners.Count;

    /// <summary>The time before which no event is accepted any more.</summary>
    public SimTime Watermark => SharedTime.Now - Options.Window.History;

    /// <inheritdoc/>
    public override IReadOnlyList<LinkTraffic> Links => joiners.ConvertAll(j => j.Link.Traffic);

    /// <inheritdoc/>
    public override uint LogLength => log.Count;

    /// <summary>How much of the log is kept: what is not settled, and what some joiner has not acknowledged.</summary>
    internal int KeptLogEntries => log.Kept;

    /// <summary>Has the next step write to every joiner, which otherwise may wait for the keep-alive: they learn sooner what is committed.</summary>
    public void Hasten()
    {
        SimTime now = Clock.Now;
        foreach (Joiner joiner in joiners)
        {
            joiner.Link.Hasten(now);
        }
    }

    private protected override void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from)
    {
        if (State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            return;
        }

        switch (type)
        {
            case DatagramType.Knock when IsWellFormed(KnockDatagram.TryDecode(datagram, out KnockDatagram knock, out _)):
                Challenge(knock.Nonce, from);
                break;
            case DatagramType.Join when IsWellFormed(JoinDatagram.TryDecode(datagram, out JoinDatagram join, out _)):
                OnJoin(join, from);
                break;
            case DatagramType.Fetch when IsWellFormed(FetchDatagram.TryDecode(datagram, out FetchDatagram fetch, out _)):
                OnFetch(fetch, from);
                break;
            case DatagramType.Doubt when IsWellFormed(DoubtDatagram.TryDecode(datagram, out DoubtDatagram doubt, out _)):
                OnDoubt(doubt, from);
                break;
            case DatagramType.Leave when IsWellFormed(LeaveDatagram.TryDecode(datagram, out LeaveDatagram leave, out _)):
                Counters.DatagramsIgnored +=
                    LetGo(j => j.Link.Other == from && j.Peer == leave.Peer && j.Link.SessionId == leave.SessionId) ? 0 : 1;
                break;
            case DatagramType.Welcome or DatagramType.Refusal or DatagramType.Challenge or DatagramType.Chunk or DatagramType.Evidence:
                Counters.DatagramsIgnored++; // a host's own words
                break;
        }
    }

    // A loop, since a delegate would be allocated for every datagram.
    private Joiner? JoinerAt(PeerAddress from)
    {
        foreach (Joiner joiner in joiners)
        {
            if (joiner.Link.Other == from)
            {
                return joiner;
            }
        }

        return null;
    }

    private protected override void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        Joiner? joiner = JoinerAt(from);
        if (joiner is null || update.SessionId != joiner.Link.SessionId || update.Peer != joiner.Peer || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            if (State == SessionState.Ended || update.SessionId != joiner?.Link.SessionId)
            {
                // It has not heard the goodbye, or never was one of ours. Told with its own session's number, and in fewer bytes than it sent.
                SayGoodbye(from, update.SessionId, State == SessionState.Ended ? LeaveReason.HostEnded : LeaveReason.NotJoined);
            }

            return;
        }

        SimTime now = Clock.Now;
        if (!joiner.Link.Note(update, now, out _))
        {
            Counters.DatagramsIgnored++;
            return;
        }

        joiner.Link.CountReceived(update.EncodedLength);
        joiner.HasWritten = true;
        joiner.IsReady |= update.Ready;
        joiner.HasBegun |= update.Start != SimTime.MinValue;
        if (update.EventsReceived <= log.Count)
        {
            joiner.Outgoing.Acknowledge(update.EventsReceived);
        }

        uint sequence = update.FirstIndex;
        bool isNear = true;
        bool canWait = update.Held.Length > 0;
        foreach (UpdateEntry entry in update.Held)
        {
            isNear &= joiner.Incoming.Put(sequence++, entry);
            canWait &= !entry.IsOwn && IsMadeUpFor(entry.Event);
        }

        Counters.DatagramsIgnored += isNear ? 0 : 1; // further ahead than any joiner of ours goes
        Counters.EventsDeferred += JudgeNext(joiner, now) ? 0 : 1;

        // An answer at once: it carries the acknowledgement, and the joiner's clock has its exchange without waiting. Knots come many a second, and have time.
        joiner.Link.Hasten(canWait ? now + MostAckDelay : now);
    }

    private protected override void Tend(SimTime now)
    {
        for (int i = joiners.Count - 1; i >= 0; i--)
        {
            bool isSilent = now - joiners[i].Link.Heard > PatienceWith(joiners[i]);
            if (isSilent || log.Count - joiners[i].Acknowledged > MaxUnacknowledged)
            {
                SayGoodbye(joiners[i].Link, isSilent ? LeaveReason.TimedOut : LeaveReason.FellBehind);
                LetGo(i);
            }
        }

        if (now > MaxClock)
        {
            Farewell();
            End(SessionEnd.Failed, FormattableString.Invariant($"The session has lasted {MaxClock.ToSeconds():F0} s, the longest there is; host a new one."));
            return;
        }

        if (World is null && joiners.Count(j => j.IsReady) >= Options.ExpectedJoiners)
        {
            Begin(now + Options.StartLead);
            Hasten();
        }

        foreach (Joiner joiner in joiners)
        {
            JudgeNext(joiner, now); // what was left for later
        }

        Commit(Watermark);
        SettleLog();
        ForgetCopies(now);
        log.ForgetUpTo(joiners.Aggregate(newestCopy?.LogIndex ?? uint.MaxValue, (least, joiner) => Math.Min(least, joiner.Acknowledged)));
        foreach (Joiner joiner in joiners)
        {
            if (joiner.HasWritten && joiner.Link.Due <= now)
            {
                SendUpdates(joiner, now);
            }
        }
    }

    private SimDuration PatienceWith(Joiner joiner) => joiner.HasWritten || Options.Timeout < SilentPlace ? Options.Timeout : SilentPlace;

    private protected override SimTime NextDue(SimTime now)
    {
        SimTime due = NextCommit(Options.Window.History);
        foreach (Joiner joiner in joiners)
        {
            due = SimTime.Min(due, joiner.HasWritten ? joiner.Link.Due : joiner.Link.Heard + PatienceWith(joiner) + SimDuration.OneTick);
            due = joiner.Incoming.HasNext ? SimTime.Min(due, now + Options.ResendInterval) : due;
        }

        return due;
    }

    private protected override void Publish(in ExternalEvent external) => Record(external, Verdict.Accepted);

    private protected override void Farewell()
    {
        for (int n = 0; n < Goodbyes; n++)
        {
            foreach (Joiner joiner in joiners)
            {
                SayGoodbye(joiner.Link, LeaveReason.HostEnded);
            }
        }
    }

    /// <summary>Forgets the joiner of which that holds, of which there is one at most.</summary>
    private bool LetGo(Predicate<Joiner> isIt)
    {
        int index = joiners.FindIndex(isIt);
        if (index >= 0)
        {
            LetGo(index);
        }

        return index >= 0;
    }

    private void LetGo(int index)
    {
        LinkTraffic link = joiners[index].Link.Traffic;
        joiners.RemoveAt(index);
        JoinerGone?.Invoke(link);
    }

    private void SayGoodbye(PeerAddress to, ulong itsSession, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(itsSession, 0, reason).Encode(bytes)), to);
    }

    /// <summary>Judges what a joiner did, in order, as far as it is here.</summary>
    /// <returns>False if something is left for later, because the joiner did too much.</returns>
    private bool JudgeNext(Joiner joiner, SimTime now)
    {
        while (joiner.Incoming.HasNext)
        {
            if (!joiner.Events.TrySpend(now))
            {
                return false;
            }

            UpdateEntry entry = joiner.Incoming.Take();
            lastSequences[joiner.Peer] = joiner.EventsReceived;
            Judge(entry, joiner.Peer, joiner.EventsReceived);
        }

        return true;
    }

    private void Judge(in UpdateEntry entry, byte sender, uint sequence)
    {
        ExternalEvent external = entry.Event;
        if (entry.IsOwn || external.Peer != sender || external.Sequence != sequence)
        {
            // In another's name; in the log it would have that other take back what it did itself.
            Counters.EventsRefused++;
            Counters.EventsForged++;
            return;
        }

        SimTime now = SharedTime.Now;
        Verdict verdict = World is null || !MayEnter(external) ? Verdict.Invalid
            : !EventRights.Has(external, Scene!) ? Verdict.NoRight
            : external.Time < now - Options.Window.History || external.Time < World.Simulation.Start ? Verdict.TooLate
            : external.Time > now + Options.Window.History ? Verdict.TooEarly
            : Limits.WhyNot(external, World.Simulation, now, out _);
        if (verdict == Verdict.Accepted)
        {
            Limits.Note(external);
            Apply(external);
        }

        Record(external, verdict);
    }

    private void Record(in ExternalEvent external, Verdict verdict)
    {
        Counters.EventsAccepted += verdict == Verdict.Accepted ? 1 : 0;
        Counters.EventsRefused += verdict == Verdict.Accepted ? 0 : 1;
        log.Add(external, verdict, SimTime.Min(Watermark, external.Time)); // it was judged, or done, a little earlier
        lastUrgent = verdict == Verdict.Accepted && IsMadeUpFor(external) ? lastUrgent : log.Count;
        Tell(log[log.Count]);
        SimTime now = Clock.Now;
        foreach (Joiner joiner in joiners)
        {
            bool canWait = log.Count != lastUrgent && joiner.Peer == external.Peer; // who did it knows it already
            joiner.Link.Hasten(canWait ? now + MostAckDelay : now);
        }
    }

    private void SendUpdates(Joiner joiner, SimTime now)
    {
        bool hasMore = true;
        for (int n = 0; hasMore && n < SendWindow.MaxDatagramsAtOnce; n++)
        {
            hasMore = SendUpdate(joiner, now);
        }
    }

    /// <summary>Sends one update; whether there is more to be sent at once.</summary>
    private bool SendUpdate(Joiner joiner, SimTime now)
    {
        UpdateDatagram update = joiner.Link.Compose(now);
        update.EventsReceived = joiner.EventsReceived;
        update.Start = World?.Simulation.Start ?? SimTime.MinValue;
        if (Committed is CommittedState committed)
        {
            update.HasStateHash = true;
            update.HashTime = committed.Time;
            update.StateHash = committed.StateHash;
        }

        logView.Reader = joiner;
        bool hasMore = joiner.Outgoing.Fill(update, logView, now, TimesOf(joiner.Link));

        // The watermark is a promise about what comes after this update's last entry: the one at which the next entry was added, or as there is none, now's.
        uint last = update.FirstIndex + (uint)update.Held.Length - 1;
        update.Watermark = World is null ? SimTime.MinValue : last < log.Count ? log.WatermarkAfter(last) : Watermark;
        bool isUrgent = joiner.Acknowledged < Math.Min(lastUrgent, logView.Last) || joiner.Outgoing.HasLost
            || (World is not null && joiner.IsReady && !joiner.HasBegun);
        SimDuration wait = WaitAfterUpdate(isUrgent, joiner.Acknowledged < logView.Last, joiner.Link, now, Overdue);
        Send(joiner.Link.Seal(hasMore ? now : now + wait), joiner.Link);
        return hasMore;
    }

    /// <summary>The log as one joiner gets it: of what it did itself only the number travels back; a former one of its number is another.</summary>
    private sealed class LogView : IEntrySource
    {
        private readonly VerdictLog log;

        internal LogView(VerdictLog log) => this.log = log;

        internal Joiner? Reader { get; set; }

        public uint Last => Reader!.IsReady ? log.Count : Reader.Acknowledged;

        public UpdateEntry this[uint number]
        {
            get
            {
                LogEntry entry = log[number];
                return entry.Event.Peer == Reader!.Peer && entry.Event.Sequence > Reader.FirstSequence
                    ? new UpdateEntry(entry.Verdict, entry.Event.Sequence)
                    : new UpdateEntry(entry.Verdict, entry.Event);
            }
        }
    }

    private sealed class Joiner
    {
        internal Joiner(ulong nonce, UpdateLink link, Copy copy, uint firstSequence, RateLimit events, RateLimit pieces)
        {
            Nonce = nonce;
            Link = link;
            Copy = copy;
            FirstSequence = firstSequence;
            Incoming = new ReceiveWindow(firstSequence);
            Outgoing = new SendWindow(copy.LogIndex);
            Events = events;
            Pieces = pieces;
            Doubts = new RateLimit(2, RecentEvents.Most / DoubtDatagram.MaxEvents, link.Heard);
        }

        internal byte Peer => Link.Peer;

        internal ulong Nonce { get; }

        internal UpdateLink Link { get; }

        /// <summary>What it fetches; null once it has it.</summary>
        internal Copy? Copy { get; set; }

        /// <summary>The last request for pieces of it that was answered.</summary>
        internal uint Fetches { get; set; }

        /// <summary>The last sequence number of those who had its number before.</summary>
        internal uint FirstSequence { get; }

        /// <summary>How many of its events are judged.</summary>
        internal RateLimit Events { get; }

        /// <summary>How many pieces of its copy it gets.</summary>
        internal RateLimit Pieces { get; }

        /// <summary>How many of its questions about a difference are answered: two a second, and as many at once as a whole answer takes.</summary>
        internal RateLimit Doubts { get; }

        /// <summary>The last such question that was answered.</summary>
        internal uint Doubted { get; set; }

        /// <summary>How many it got.</summary>
        internal long PiecesGiven { get; set; }

        /// <summary>Whether it has scene, state and clock, and so wants the log.</summary>
        internal bool IsReady { get; set; }

        /// <summary>Whether it knows when the session starts.</summary>
        internal bool HasBegun { get; set; }

        /// <summary>Whether an update of it came. Until then it gets none.</summary>
        internal bool HasWritten { get; set; }

        /// <summary>How many entries of the log it has.</summary>
        internal uint Acknowledged => Outgoing.Acknowledged;

        /// <summary>How many of its events are judged, those of former holders of its number included.</summary>
        internal uint EventsReceived => Incoming.Received;

        /// <summary>What it is told of the log.</summary>
        internal SendWindow Outgoing { get; }

        /// <summary>What it did.</summary>
        internal ReceiveWindow Incoming { get; }
    }
}
