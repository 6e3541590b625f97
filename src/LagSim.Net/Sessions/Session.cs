using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Security.Cryptography;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Carriers;
using LagSim.Net.Clocks;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>One peer's part in a shared world: it talks through a datagram port, keeps the shared time, and keeps a world ahead of it.</summary>
/// <remarks>
/// For one thread, in real time (<see cref="PeerThread"/> gives it one) or in virtual time, where the harness steps it. From any thread may
/// be read: <see cref="Scene"/>, <see cref="SharedTime"/>, <see cref="State"/>, <see cref="EndReason"/>, <see cref="Committed"/>, and which
/// <see cref="World"/> it is; of the world itself only its pictures, its counts of late steps, and when it started.
/// </remarks>
public abstract partial class Session
{
    /// <summary>As often a goodbye is said at once; who has not heard it hears it again in answer to what it sends, for as long as the port is there.</summary>
    private protected const int Goodbyes = 3;

    /// <summary>The furthest that a clock may have run, 23 days: so long a session can last.</summary>
    internal static readonly SimTime MaxClock = SimTime.FromSeconds(2_000_000); // the estimate of another clock takes readings of up to 24 days

    private readonly ILateEventStrategy strategy;
    private readonly ContactNotices? contacts;
    private readonly CancellationTokenSource interruption = new();
    private readonly CancellationToken cancellation;
    private readonly UpdateDatagram outgoing = new();
    private readonly byte[] sending = new byte[IDatagramPort.MaxDatagramBytes];
    private readonly CancellationTokenRegistration watch;
    private bool hasUnshown;
    private SimTime begunAt = SimTime.MaxValue; // the earliest instant of the world; there before the world is
    private volatile SessionState state;
    private volatile string? endReason;
    private volatile SessionEnd endedBy;
    private volatile LiveWorld? world;
    private volatile Scene? scene;

    private protected Session(Scene? scene, IDatagramPort port, IClock clock, SessionOptions options)
    {
        this.scene = scene;
        Port = port ?? throw new ArgumentNullException(nameof(port));
        Clock = clock ?? throw new ArgumentNullException(nameof(clock));
        Options = options ?? throw new ArgumentNullException(nameof(options));
        options.Check();
        cancellation = options.Cancellation;
        if (clock.Now > MaxClock)
        {
            throw new ArgumentException(
                FormattableString.Invariant($"The clock reads {clock.Now.ToSeconds():F0} s; a session takes one that reads less than {MaxClock.ToSeconds():F0} s. Make a new one."),
                nameof(clock));
        }

        Limits = new PlayerLimits(options);
        Recent = new RecentEvents();
        strategy = LateEventStrategies.Create(options.Strategy, options.DisplayDelay);
        if (options.SyncTest && !(strategy.RewritesPast && strategy.Mode == HealingMode.CausalCone))
        {
            throw new ArgumentException(
                $"The strategy is '{options.Strategy}', which does not heal; a sync test is for one that does: healing or interpolation.", nameof(options));
        }

        contacts = options.Contacts;
        SharedTime = new SharedClock(clock);
        watch = cancellation.Register(static session => ((Session)session!).Interrupt(), this);
    }

    /// <summary>
    /// Raised on the session's thread, once, when there is a <see cref="World"/> and nothing has happened in it yet. Handlers must not throw.
    /// </summary>
    public event Action? Begun;

    /// <summary>
    /// Raised on the session's thread each time that a fresh copy of the host's world has taken the place of <see cref="World"/>, which is another object from
    /// then on, with why. What this peer did that the host had not judged is in neither. Handlers must not throw.
    /// </summary>
    public event Action<string>? Renewed;

    /// <summary>Raised on the thread that ended the session, once; <see cref="EndReason"/> tells why. Handlers must not throw.</summary>
    public event Action? Ended;

    /// <summary>Raised on the session's thread for every line of the log, in order, once it has taken effect here. Handlers must not throw.</summary>
    public event Action<LogEntry>? Logged;

    /// <summary>The scene that all peers share; null for a joiner that has not heard of it. From any thread.</summary>
    public Scene? Scene
    {
        get => scene;
        private protected set => scene = value;
    }

    /// <summary>The session's time; readable once <see cref="SharedClock.IsSet"/>, from any thread.</summary>
    public SharedClock SharedTime { get; }

    /// <summary>
    /// How far behind the shared time this peer shows the world: <see cref="SessionOptions.DisplayDelay"/> with <c>interpolation</c>, else zero. From any
    /// thread.
    /// </summary>
    public SimDuration DisplayDelay => strategy.DisplayDelay;

    /// <summary>
    /// What a frame that is drawn now reads of a picture: shared time less <see cref="DisplayDelay"/>. In the first moments, when that lies before the world
    /// this peer has, the earliest instant of it, so that the world stands still until it can be shown on its way. From any thread, once there is a <see
    /// cref="World"/>.
    /// </summary>
    public SimTime DisplayTime
    {
        get
        {
            SimTime shared = SharedTime.Now;
            return SimTime.Max(shared - DisplayDelay, SimTime.Min(shared, begunAt));
        }
    }

    /// <summary>Where the peer stands. From any thread.</summary>
    public SessionState State
    {
        get => state;
        private protected set => state = value;
    }

    /// <summary>Why the session ended, as a sentence; null while it goes on. From any thread: it is there once <see cref="State"/> says so.</summary>
    public string? EndReason => endReason;

    /// <summary>What ended the session. From any thread, as <see cref="EndReason"/>.</summary>
    public SessionEnd EndedBy => endedBy;

    /// <summary>This peer's number; 0 is the host. Meaningful once joined.</summary>
    public byte Peer { get; private protected set; }

    /// <summary>
    /// The world, from the moment its start is known; the same from then on, but for a joiner that got a fresh copy (<see cref="Renewed"/>). From any thread,
    /// but see the remarks for what is in it.
    /// </summary>
    public LiveWorld? World => world;

    /// <summary>What the world went on from, for a joiner that came late enough; null where it began with the scene. On the session's thread.</summary>
    public WorldSnapshot? BegunFrom { get; private set; }

    /// <summary>
    /// How many lines of the host's log this peer was not told, because every accepted event in them is in <see cref="BegunFrom"/>; the next is the
    /// first that <see cref="Logged"/> tells. On the session's thread.
    /// </summary>
    public uint LogStart { get; private protected set; }

    /// <summary>
    /// What went over each link so far; of a host in the order in which its joiners came. On the session's thread; see <see cref="PeerThread.Ask"/>.
    /// </summary>
    public abstract IReadOnlyList<LinkTraffic> Links { get; }

    /// <summary>How many lines of the host's log this peer has, those included that were in the state it began from. On the session's thread.</summary>
    public abstract uint LogLength { get; }

    /// <summary>What was counted; it goes on counting. On the session's thread: another gets a <see cref="SessionCounters.Copy"/>.</summary>
    public SessionCounters Counters { get; } = new();

    /// <summary>Whether all peers with this strategy end up with the same world, bit for bit.</summary>
    public bool PromisesAgreement => strategy.PromisesAgreement;

    /// <summary>The strategy that a thread warms up for before it steps this session; null for none.</summary>
    internal string? WarmsUpFor => Options.Warmup ? Options.Strategy : null;

    private protected IDatagramPort Port { get; }

    private protected IClock Clock { get; }

    private protected SessionOptions Options { get; }

    /// <summary>What players may do at most; a host judges by it.</summary>
    private protected PlayerLimits Limits { get; private set; }

    /// <summary>The newest lines of the log, for what a difference is explained by.</summary>
    private protected RecentEvents Recent { get; private set; }

    /// <summary>Whether the line of the log that is told next has no effect here, though the host accepted it.</summary>
    private protected bool IsWithoutEffect { get; set; }

    /// <summary>The number of this peer's newest event.</summary>
    private protected uint LastSequence { get; set; }

    /// <summary>A number that nobody can guess, for a host's session or a joiner's nonce. From any thread.</summary>
    public static ulong DrawNumber()
    {
        Span<byte> bytes = stackalloc byte[sizeof(ulong)];
        RandomNumberGenerator.Fill(bytes);
        return BinaryPrimitives.ReadUInt64LittleEndian(bytes);
    }

    /// <summary>
    /// Has a step that is simulating end soon, by an <see cref="OperationCanceledException"/>; from any thread. The world stands still from then on.
    /// </summary>
    internal void Interrupt() => interruption.Cancel();

    /// <summary>Says goodbye and ends the session. The world stays readable.</summary>
    public void Leave()
    {
        if (State != SessionState.Ended)
        {
            Farewell();
            End(SessionEnd.Left, "This peer left.");
        }
    }

    private protected abstract void OnDatagram(DatagramType type, ReadOnlySpan<byte> datagram, PeerAddress from);

    /// <summary>Something of another version of the protocol; of it only what is the same in all may be read.</summary>
    private protected abstract void OnOtherVersion(ReadOnlySpan<byte> datagram, PeerAddress from);

    private protected abstract void OnUpdate(UpdateDatagram update, PeerAddress from);

    /// <summary>Whatever is due by the own clock, sending included.</summary>
    private protected abstract void Tend(SimTime now);

    private protected abstract SimTime NextDue(SimTime now);

    /// <summary>Sees to it that the others hear of an own event.</summary>
    private protected abstract void Publish(in ExternalEvent external);

    private protected abstract void Farewell();

    private protected void End(SessionEnd by, string reason)
    {
        if (State == SessionState.Ended)
        {
            return;
        }

        watch.Dispose(); // a token of the whole program would keep all sessions there ever were
        endedBy = by;
        endReason = reason; // first: who reads that it ended reads why
        State = SessionState.Ended;
        Ended?.Invoke();
    }

    /// <summary>Makes the world, once its start is known.</summary>
    private protected void Begin(SimTime start)
    {
        if (world is null || State == SessionState.Rejoining)
        {
            bool isFirst = Forget();
            begunAt = start;
            world = new LiveWorld(Scene!, WorldOptions(start), Options.Window.LookAhead, Options.PicturePast + DisplayDelay, contacts)
            {
                Work = new WorkLedger(Clock),
                WaitsForLateEvents = true,
            };
            schedule = new CommitSchedule(start, start, Options.CommitInterval);
            BegunFrom = null;
            TellBegun(isFirst);
        }
    }

    /// <summary>Makes the world from what it was committed to be.</summary>
    /// <exception cref="SceneException">It is no world of the scene.</exception>
    private protected void Begin(WorldSnapshot snapshot)
    {
        bool isFirst = Forget();
        LiveWorld copied = new(Scene!, snapshot, WorldOptions(snapshot.Start), Options.Window.LookAhead, Options.PicturePast + DisplayDelay, contacts)
        {
            Work = new WorkLedger(Clock),
            WaitsForLateEvents = true,
        };
        begunAt = copied.Simulation.HistoryEdge;
        world = copied;
        schedule = new CommitSchedule(snapshot.Start, snapshot.Time, Options.CommitInterval);
        BegunFrom = snapshot;
        TellBegun(isFirst);
    }

    /// <summary>Why the world is to be replaced, or was the last time.</summary>
    private protected string RenewedBecause { get; set; } = "";

    private void TellBegun(bool isFirst)
    {
        if (isFirst)
        {
            Begun?.Invoke();
        }
        else
        {
            Counters.Renewals++;
            Renewed?.Invoke(RenewedBecause);
        }
    }

    /// <summary>Begins anew with what belongs to one world, and not to the next; true if there has been none.</summary>
    private bool Forget()
    {
        if (world is null)
        {
            return true;
        }

        world.Retire();
        Limits = new PlayerLimits(Options);
        Recent = new RecentEvents();
        settled = SimTime.MinValue;
        hasUnshown = false;
        return false;
    }

    // The session itself decides what is forgotten, by the watermark; the simulation's own limit would go by its look-ahead.
    private SimulationOptions WorldOptions(SimTime start) =>
        new(
            start, SimDuration.MaxValue, Options.MaxSegments, interruption.Token, Options.SyncTest ? HealingMode.SyncTest : strategy.Mode, Options.Threads);

    /// <summary>
    /// Whether one end of a link has not heard of the other when it should have. They then write as if something were unacknowledged: else a
    /// burst of losses, which is counted in datagrams, would last as long as the timeout.
    /// </summary>
    private protected bool IsOverdue(SimDuration silence) => silence > Overdue;

    /// <summary>
    /// How long a silence is overdue. A host waits as long before it writes of itself: a joiner's keep-alives, which it answers, do for both.
    /// </summary>
    private protected SimDuration Overdue => Options.KeepAlive + (Options.KeepAlive / 4);

    /// <summary>
    /// Whether the next of its kind carries what this one would have, if it is lost: it waits for its acknowledgement, and need not be sent again and again.
    /// </summary>
    internal static bool IsMadeUpFor(in ExternalEvent external) => external.Kind == EventKind.HoldKnot;

    /// <summary>How long after an update the next one goes out if nothing new comes up.</summary>
    /// <param name="link">To whom.</param>
    /// <param name="isWaitedFor">Whether the other must hear of something that is no entry.</param>
    /// <param name="now">By the own clock.</param>
    /// <param name="atRest">How long where nothing is the matter.</param>
    private protected SimDuration RestAfterUpdate(UpdateLink link, bool isWaitedFor, SimTime now, SimDuration atRest)
    {
        if (!isWaitedFor && !IsOverdue(link.Silence(now)))
        {
            return atRest;
        }

        return link.Trips.HasQueue && link.Trips.Mean > Options.ResendInterval ? link.Trips.Mean : Options.ResendInterval;
    }

    private protected UpdateLink LinkTo(PeerAddress other, ulong sessionId, byte peer, uint acknowledged, SimTime now) =>
        new(sessionId, Peer, peer, other, acknowledged, Options.ResendInterval, outgoing, sending, now, Fault);

    /// <summary>Counts a datagram that could not be decoded.</summary>
    private protected bool IsWellFormed(bool decoded)
    {
        Counters.DatagramsMalformed += decoded ? 0 : 1;
        return decoded;
    }

    private protected void Send(ReadOnlySpan<byte> datagram, PeerAddress to)
    {
        Port.Send(datagram, to);
        Counters.DatagramsSent++;
    }

    private protected void Send(ReadOnlySpan<byte> datagram, UpdateLink link)
    {
        Send(datagram, link.Other);
        link.CountSent(datagram.Length);
    }

    private protected void SayGoodbye(UpdateLink link, LeaveReason reason)
    {
        Span<byte> bytes = stackalloc byte[WireFormat.LeaveBytes];
        Send(bytes.Slice(0, new LeaveDatagram(link.SessionId, Peer, reason).Encode(bytes)), link);
    }

    /// <summary>What is done wrong on purpose; set before the first step.</summary>
    internal SessionFault Fault { get; set; }

    /// <summary>Asks for a fresh copy of the world in place of one that cannot be gone on with; false where there is none to be had.</summary>
    private protected virtual bool TryRenew(SessionEnd by, string why) => false;

    /// <summary>Nothing is to be read from a world that failed; the pictures that were published still can be.</summary>
    private void EndWorld(SimulationException failure)
    {
        bool isFull = failure is TimelinesFullException;
        if (isFull && TryRenew(SessionEnd.TimelinesFull, $"This peer had no more room for what may still change. {failure.Message}"))
        {
            return;
        }

        if (State == SessionState.Ended)
        {
            return; // a fresh copy would be of no use: said already
        }

        Farewell();
        End(
            isFull ? SessionEnd.TimelinesFull : SessionEnd.Failed,
            isFull ? $"This peer has no more room for what may still change, and left; it can join again. {failure.Message}" : $"The world cannot be simulated"
                + $" any further. {failure.Message}");
    }
}
