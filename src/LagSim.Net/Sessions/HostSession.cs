using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Hosting;
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
    private readonly List<Joiner> joiners = new(); // those that are still coming in among them
    private readonly PlayerPlaces places;
    private readonly ulong sessionId;
    private readonly HashSet<PeerAddress> banned = new(); // machines
    private ulong joins;
    private SimTime tended; // own clock, when this host last looked after its joiners
    private SimTime watermark = SimTime.MinValue;
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
        tended = clock.Now;
        places = new PlayerPlaces(options, tended);
        logView = new LogView(log);
        door = options.Door;
        paces = new CopyPaces(door);
        cookies = new JoinCookies();
        sceneCopy = WorldCopy.Encode(scene, null);
        SharedTime.Adjust(SimDuration.Zero);
        State = SessionState.Waiting;
    }

    /// <summary>
    /// Raised on the session's thread for each joiner that has a copy of scene and state and got its number, with its link. Handlers must not throw.
    /// </summary>
    public event Action<LinkTraffic>? JoinerCame;

    /// <summary>
    /// Raised on the session's thread, once, for each joiner that left, fell silent, was told to go, or came anew from the same address, with what went over
    /// its link in all. Not for those who are there when the session ends. Handlers must not throw.
    /// </summary>
    public event Action<LinkTraffic>? JoinerGone;

    /// <summary>How many joiners there are now, without those that are still coming in.</summary>
    public int JoinerCount
    {
        get
        {
            int count = 0;
            foreach (Joiner joiner in joiners)
            {
                count += joiner.Peer > 0 ? 1 : 0;
            }

            return count;
        }
    }

    /// <summary>
    /// The time before which no event is accepted any more: the history before the clock, or before where the world stands if that is behind. It never goes back.
    /// </summary>
    /// <remarks>What a host that stands still has not simulated can still be changed, by the removal of what makes it stand, above all.</remarks>
    public SimTime Watermark
    {
        get
        {
            SimTime now = SharedTime.Now;
            SimTime simulated = World is null ? now : SimTime.Min(now, World.Simulation.SimulatedTo);
            return watermark = SimTime.Max(watermark, simulated - Options.Window.History);
        }
    }

    /// <inheritdoc/>
    public override IReadOnlyList<LinkTraffic> Links => joiners.FindAll(j => j.Peer > 0).ConvertAll(j => j.Link.Traffic);

    /// <inheritdoc/>
    public override uint LogLength => log.Count;

    /// <summary>How much of the log is kept: what is not settled, and what some joiner has not acknowledged.</summary>
    internal int KeptLogEntries => log.Kept;

    /// <summary>How many are coming in.</summary>
    internal int ComingCount => joiners.Count - JoinerCount;

    /// <summary>Has the next step write to every joiner, which otherwise may wait for the keep-alive: they learn sooner what is committed.</summary>
    public void Hasten()
    {
        SimTime now = Clock.Now;
        foreach (Joiner joiner in joiners)
        {
            joiner.Link.Hasten(now);
        }
    }

    /// <summary>Sends a player away. It is told so, and its session ends. Its number becomes free and its pass void; it may join again as a new player.</summary>
    /// <remarks>What it did stays, and so do the bodies that it spawned: see <see cref="RemoveBodiesOf"/>. On the session's thread.</remarks>
    /// <param name="player">The player's number.</param>
    /// <returns>False if nobody has that number now.</returns>
    /// <exception cref="ArgumentOutOfRangeException">It is not from 1 to <see cref="SessionOptions.MaxJoiners"/>.</exception>
    public bool Kick(byte player)
    {
        ThrowIfNoPlayer(player);
        return SendAway(j => j.Peer == player) > 0;
    }

    /// <summary>
    /// Sends away all players from the machine of one, as <see cref="Kick"/> does, and lets nobody in from there as long as this session lasts. A machine is an IP address,
    /// of IPv6 its first 64 bits: everybody who shares it is shut out.
    /// </summary>
    /// <remarks>On the session's thread.</remarks>
    /// <param name="player">The player's number.</param>
    /// <returns>The machine, for <see cref="Unban"/>; null if nobody has that number now.</returns>
    /// <exception cref="ArgumentOutOfRangeException">It is not from 1 to <see cref="SessionOptions.MaxJoiners"/>.</exception>
    public PeerAddress? Ban(byte player)
    {
        ThrowIfNoPlayer(player);
        if (joiners.Find(j => j.Peer == player) is not Joiner found)
        {
            return null;
        }

        PeerAddress machine = found.Link.Other.Machine;
        banned.Add(machine);
        SendAway(j => j.Link.Other.Machine == machine);
        return machine;
    }

    /// <summary>Lets players in again from a machine: one that was banned, or one that is shut out for a while because a player from there cost too much.</summary>
    /// <param name="machine">What <see cref="Ban"/> gave, or any address of the machine.</param>
    /// <returns>False if it was not shut out.</returns>
    public bool Unban(PeerAddress machine)
    {
        bool wasBanned = banned.Remove(machine.Machine);
        return LetInAgain(machine.Machine, Clock.Now) || wasBanned;
    }

    /// <summary>
    /// Removes all bodies that were spawned under a player's number, whether or not somebody has it now. The removals are events of this host, so all peers see them at the same
    /// simulated time: now, or where the world stands if that is behind, and of a body whose spawn is still to come when it is spawned.
    /// </summary>
    /// <remarks>On the session's thread. Cost: a removal for each.</remarks>
    /// <param name="player">The player's number.</param>
    /// <returns>How many are removed.</returns>
    /// <exception cref="ArgumentOutOfRangeException">It is not from 1 to <see cref="SessionOptions.MaxJoiners"/>.</exception>
    /// <exception cref="InvalidOperationException">The session is not running.</exception>
    public int RemoveBodiesOf(byte player)
    {
        ThrowIfNoPlayer(player);
        if (World is not LiveWorld world || State != SessionState.Running)
        {
            throw new InvalidOperationException($"Nothing can be removed while the session is {State}.");
        }

        SimTime now = SharedTime.Now + Options.Window.LocalLag(EventKind.Remove);
        return RemoveSpawned(null, player, world.IsBehind ? SimTime.Min(now, world.Simulation.SimulatedTo) : now);
    }

    private static void ThrowIfNoPlayer(byte player)
    {
        if (player is 0 or > SessionOptions.MaxJoiners)
        {
            throw new ArgumentOutOfRangeException(nameof(player), player, $"A player's number is 1 to {SessionOptions.MaxJoiners}.");
        }
    }

    private int SendAway(Predicate<Joiner> isIt)
    {
        List<Joiner> all = joiners.FindAll(isIt);
        foreach (Joiner joiner in all)
        {
            for (int n = 0; n < Goodbyes; n++)
            {
                SayGoodbye(joiner.Link, LeaveReason.Kicked);
            }

            LetGo(j => j == joiner, LeaveReason.Kicked);
        }

        return all.Count;
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
                Counters.DatagramsIgnored += LetGo(
                    j => j.Link.Other == from && (j.Peer == leave.Peer || leave.Peer == 0) && j.Link.SessionId == leave.SessionId, LeaveReason.Left) ? 0 : 1;
                break;
            case DatagramType.Move when IsWellFormed(MoveDatagram.TryDecode(datagram, out MoveDatagram move, out _)):
                OnMove(move, from);
                break;
            case DatagramType.Welcome or DatagramType.Refusal or DatagramType.Challenge or DatagramType.Chunk or DatagramType.Evidence or DatagramType.Seat:
                Counters.DatagramsIgnored++; // a host's own words
                break;
        }
    }

    // A loop, since a delegate would be allocated for every datagram.
    private Joiner? JoinerOf(ulong session)
    {
        foreach (Joiner joiner in joiners)
        {
            if (joiner.Link.SessionId == session)
            {
                return joiner;
            }
        }

        return null;
    }

    private protected override void OnUpdate(UpdateDatagram update, PeerAddress from)
    {
        Joiner? joiner = JoinerOf(update.SessionId);
        if (joiner is not null && joiner.Link.Other != from && State != SessionState.Ended)
        {
            Counters.DatagramsIgnored++; // what it says comes again, once it has shown that it is there
            Challenge(update.SessionId, from);
            return;
        }

        if (joiner is null || (update.Peer != joiner.Peer && update.Peer != 0) || State == SessionState.Ended)
        {
            Counters.DatagramsIgnored++;
            if (State == SessionState.Ended || joiner is null)
            {
                // It has not heard the goodbye, or never was one of ours. Told with its own session's number, and in fewer bytes than it sent.
                SayGoodbye(from, update.SessionId, State == SessionState.Ended ? LeaveReason.HostEnded : places.WhyGone(update.SessionId));
            }

            return;
        }

        SimTime now = Clock.Now;
        if (now - joiner.Link.Heard > Options.Timeout / 2)
        {
            joiner.NoteSilence();
        }

        if (!joiner.Link.Note(update, now, out _))
        {
            Counters.DatagramsIgnored++;
            return;
        }

        joiner.Link.CountReceived(update.EncodedLength);
        joiner.NoteEcho(update.EchoNumber);
        joiner.HasWritten = true;
        if (update.Ready && joiner.Peer == 0 && !TrySeat(joiner, now))
        {
            return;
        }

        joiner.HasBegun |= update.Start != SimTime.MinValue;
        if (update.Peer == 0)
        {
            if (joiner.Peer > 0)
            {
                GiveSeat(joiner); // it has not heard which it has
            }

            joiner.Link.Answer(now);
            return;
        }

        if (update.EventsReceived <= log.Count)
        {
            joiner.Link.Acknowledge(update.EventsReceived, now);
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
        if (canWait)
        {
            joiner.Link.Hasten(now + UpdateLink.MostAckDelay);
        }
        else
        {
            joiner.Link.Answer(now);
        }
    }

    private protected override void Tend(SimTime now)
    {
        bool hasSlept = now - tended > Options.Timeout / 2; // it was this machine that slept: who was not listened to was not silent
        tended = now;
        for (int i = joiners.Count - 1; i >= 0; i--)
        {
            Joiner joiner = joiners[i];
            if (hasSlept)
            {
                joiner.NoteSilence();
                joiner.Link.NoteHeard(now);
            }

            bool isSilent = now - joiner.Link.Heard > PatienceWith(joiner) || (joiner.Peer == 0 && now > joiner.ComesUntil);
            if (isSilent || HasFallenBehind(joiner, now))
            {
                LeaveReason why = isSilent ? LeaveReason.TimedOut : LeaveReason.FellBehind;
                SayGoodbye(joiner.Link, why);
                LetGo(i, why);
            }
        }

        if (now > MaxClock)
        {
            Farewell();
            End(SessionEnd.Failed, FormattableString.Invariant($"The session has lasted {MaxClock.ToSeconds():F0} s, the longest there is; host a new one."));
            return;
        }

        if (World is null && JoinerCount >= Options.ExpectedJoiners)
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
            for (int n = 0; n < SendWindow.MaxDatagramsAtOnce && joiner.HasWritten && joiner.Link.IsDue(now); n++)
            {
                SendUpdate(joiner, now);
            }
        }
    }

    /// <summary>Whether a joiner is so far behind, and comes no nearer, that a fresh copy is sooner there.</summary>
    /// <remarks>
    /// By time only while it is heard: one that stands still is silent, and not behind a link that is too slow. One that came in with a large copy starts far behind, and catches up.
    /// </remarks>
    private bool HasFallenBehind(Joiner joiner, SimTime now)
    {
        SimDuration lag = joiner.Acknowledged < log.Count ? now - log.AddedAt(joiner.Acknowledged + 1) : SimDuration.Zero;
        bool isHeard = joiner.Peer > 0 && now - joiner.Link.Heard <= Options.Timeout / 2;
        return log.Count - joiner.Acknowledged > MaxUnacknowledged || (isHeard && joiner.CatchingUp.HasFailed(lag, now, Options.Timeout));
    }

    /// <summary>How long one that is coming in may take, by what it has to fetch.</summary>
    private SimDuration PatienceWithCopy(JoinCopy copy) => Options.Timeout + SilentPlace + SimDuration.FromSeconds(copy.Bytes.Length / door.SlowestCopy);

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
    private bool LetGo(Predicate<Joiner> isIt, LeaveReason why)
    {
        int index = joiners.FindIndex(isIt);
        if (index >= 0)
        {
            LetGo(index, why);
        }

        return index >= 0;
    }

    /// <param name="index">Which.</param>
    /// <param name="why">Its number is kept for it unless it left or was sent away.</param>
    private void LetGo(int index, LeaveReason why)
    {
        Joiner joiner = joiners[index];
        joiners.RemoveAt(index);
        if (joiner.Peer > 0)
        {
            places[joiner.Peer].Leave(why is not (LeaveReason.Left or LeaveReason.Kicked), joiner.Link.SessionId, why, Clock.Now);
            JoinerGone?.Invoke(joiner.Link.Traffic);
        }
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
            if (!places[joiner.Peer].Events.TrySpend(now))
            {
                return false;
            }

            UpdateEntry entry = joiner.Incoming.Take();
            places[joiner.Peer].LastSequence = joiner.EventsReceived;
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
            : external.Time < Watermark || external.Time < World.Simulation.Start ? Verdict.TooLate
            : external.Time > now + Options.Window.History ? Verdict.TooEarly
            : IsShortOfBudget(external) ? Verdict.NoRight
            : Limits.WhyNot(external, World.Simulation, now, out _);
        if (verdict == Verdict.Accepted)
        {
            Limits.Note(external);
            NoteAct(external);
            Apply(external);
        }

        Record(external, verdict);
    }

    private void Record(in ExternalEvent external, Verdict verdict)
    {
        Counters.EventsAccepted += verdict == Verdict.Accepted ? 1 : 0;
        Counters.EventsRefused += verdict == Verdict.Accepted ? 0 : 1;
        log.Add(external, verdict, SimTime.Min(Watermark, external.Time), Clock.Now); // it was judged, or done, a little earlier
        lastUrgent = verdict == Verdict.Accepted && IsMadeUpFor(external) ? lastUrgent : log.Count;
        Tell(log[log.Count]);
        SimTime now = Clock.Now;
        foreach (Joiner joiner in joiners)
        {
            if (joiner.Peer == 0)
            {
                continue;
            }

            if (log.Count != lastUrgent && joiner.Peer == external.Peer)
            {
                joiner.Link.Hasten(now + UpdateLink.MostAckDelay); // who did it knows it already
            }
            else
            {
                joiner.Link.NoteNews(UpdateDatagram.LengthOf(logView.EntryFor(joiner, log.Count)), now);
            }
        }
    }

    private void SendUpdate(Joiner joiner, SimTime now)
    {
        UpdateLink link = joiner.Link;
        UpdateDatagram update = link.Compose(now);
        bool isToBegin = World is not null && joiner.IsReady && !joiner.HasBegun;
        update.EventsReceived = joiner.EventsReceived;
        update.Start = joiner.HasBegun || World is null ? SimTime.MinValue : World.Simulation.Start;
        joiner.NoteTold(update.Number, PutHashes(update, joiner.Told));
        logView.Reader = joiner;
        link.Fill(logView, now);

        // The watermark is a promise about what comes after this update's last entry: the one at which the next entry was added, or as there is none, now's.
        uint last = update.FirstIndex + (uint)update.Held.Length - 1;
        update.Watermark = World is null ? SimTime.MinValue : last < log.Count ? log.WatermarkAfter(last) : Watermark;
        bool isUrgent = joiner.Acknowledged < Math.Min(lastUrgent, logView.Last);
        Send(link.Seal(logView, now, RestAfterUpdate(link, isToBegin, now, Overdue), isUrgent), link);
    }
}
