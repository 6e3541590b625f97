using System;
using System.Threading;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Protection;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>The options that hosts and clients share; <see cref="HostOptions"/> and <see cref="ClientOptions"/> add their own.</summary>
/// <remarks>
/// Immutable, safe on any thread; <c>with</c> makes a changed copy. Values are validated when a session is made, with an exception that
/// names the value and what is allowed.
/// </remarks>
public abstract record SessionOptions
{
    /// <summary>The default <see cref="Timeout"/>: 10 s.</summary>
    public static readonly SimDuration DefaultTimeout = SimDuration.FromSeconds(10);

    /// <summary>The most clients a host can have that play; they have the numbers from 1 on.</summary>
    public const int MaxClients = 16;

    /// <summary>The most spectators a host can have besides; they have the numbers after those of the players.</summary>
    public const int MaxSpectators = 32;

    /// <summary>The longest <see cref="Name"/>, in bytes of UTF-8.</summary>
    public const int MaxNameBytes = RosterEntry.MaxNameBytes;

    /// <summary>The highest number of a client.</summary>
    internal const byte MaxNumber = MaxClients + MaxSpectators;

    /// <summary>The longest <see cref="ConnectKey"/>, in characters.</summary>
    public const int MaxKeyLength = 256;

    private static readonly SimDuration MaxKeepAlive = SimDuration.FromSeconds(2);

    private readonly SimDuration? keepAlive;

    private protected SessionOptions()
    {
    }

    /// <summary>
    /// What the others are shown as this peer's name in <see cref="Session.Roster"/>: up to <see cref="MaxNameBytes"/> bytes of UTF-8;
    /// default empty. Two peers may have the same. <see cref="WhyNoName"/> has the rule.
    /// </summary>
    /// <remarks>If a host admits by connect tokens, the name in a player's token counts instead, if there is one.</remarks>
    public string Name { get; init; } = "";

    /// <summary>
    /// As what this peer takes part; default <see cref="PeerRole.Player"/>. A <see cref="PeerRole.Spectator"/> takes no player's place, and
    /// <see cref="Session.Do"/> throws for it.
    /// </summary>
    public PeerRole Role { get; init; } = PeerRole.Player;

    /// <summary>
    /// The shared secret: a host requires it, and a client must present it. Up to <see cref="MaxKeyLength"/> characters, default none. No
    /// half surrogate pair and no U+FFFD is in it, which stand for bytes that were no text. It is never sent.
    /// </summary>
    /// <remarks>
    /// It keeps strangers out. In a session without protection it does not encrypt: choose a long random key, since an eavesdropper or a
    /// fake host obtains data against which it can test guesses offline, and a host never proves to a client that it knows the key. In a
    /// protected session it is mixed into the keys, so both prove that they know it, and an eavesdropper cannot test guesses; a fake host
    /// can only if the client does not say which host it wants.
    /// </remarks>
    public string ConnectKey { get; init; } = "";

    /// <summary>
    /// How long a client that lost its host or its world asks to be let in again before its session ends, and how long a host reserves the
    /// number of a client that fell silent, unless another client needs it. 0 s to 1 h; default 2 min. With 0 a client's session ends at
    /// once.
    /// </summary>
    public SimDuration RejoinTime { get; init; } = SimDuration.FromSeconds(120);

    /// <summary>
    /// The highest speed in m/s that a player's event may give, above 0, up to <see cref="double.PositiveInfinity"/> for no limit beyond
    /// the world's own; default 1,000. A host refuses more as <see cref="Verdict.Invalid"/>, by its own option; a client's own
    /// <see cref="Session.Do"/> goes by the client's.
    /// </summary>
    /// <remarks>
    /// <para>It applies to the velocity of a spawn, a teleport, a set velocity, a keyframe or a release; to the surface speed of a spinning
    /// spawn; to the speed at which a held body catches up with a keyframe; and to the speed after an impulse, unless that is slower than
    /// before.</para>
    /// <para>It keeps a stranger from asking for more than anyone can simulate, such as a fast ball in a narrow gap.</para>
    /// </remarks>
    public double MaxGivenSpeed { get; init; } = 1_000;

    /// <summary>
    /// The greatest force in N that a player's hand may have, above 0, up to <see cref="double.PositiveInfinity"/>; or 0, the default, for that
    /// of a hand that asks for none: 1000 N, and 1000 N more for each kg that it holds (<see cref="Motion.HandStrength"/>). A host refuses a grab of a
    /// stronger hand as <see cref="Verdict.Invalid"/>, by its own option; a client's own <see cref="Session.Do"/> goes by the client's.
    /// </summary>
    /// <remarks>Below what a hand has by default, players have to say in <see cref="Events.PlayerAction.Grab"/> that they ask for less.</remarks>
    public double MaxHandForce { get; init; }

    /// <summary>
    /// The greatest power in W that a player's hand may have, above 0, up to <see cref="double.PositiveInfinity"/>; or 0, the default, for
    /// that of a hand that asks for none: what the greatest force that it may have gives at 50 m/s. As <see cref="MaxHandForce"/>.
    /// </summary>
    public double MaxHandPower { get; init; }

    /// <summary>How many bodies spawned by one player may exist at a time, 0 to 1,000,000; default 64.</summary>
    /// <remarks>
    /// Those of former holders of the player's number count too. A host refuses more as <see cref="Verdict.NoRight"/>, by its own
    /// option; a client's own <see cref="Session.Do"/> goes by the client's.
    /// </remarks>
    public int MaxSpawned { get; init; } = 64;

    /// <summary>
    /// The interval between committed states that are hashed, 100 ms to 60 s; default 1 s. All peers must use the same, so that states can
    /// be compared.
    /// </summary>
    public SimDuration CommitInterval { get; init; } = SimDuration.FromSeconds(1);

    /// <summary>
    /// How late an event may be and still be accepted, how far ahead the world is simulated, and how long after this peer acts its own
    /// events take effect. The history is the host's, whatever a client sets.
    /// </summary>
    public LatencyCompensationWindow Window { get; init; } = new();

    /// <summary>
    /// The maximum number of segments in all timelines of this peer, from 1; default <see cref="SimulationOptions.DefaultMaxSegments"/>.
    /// </summary>
    /// <remarks>
    /// A peer that needs more reports it and leaves (<see cref="SessionEnd.TimelinesFull"/>). It can join again, and then gets the
    /// committed world.
    /// </remarks>
    public int MaxSegments { get; init; } = SimulationOptions.DefaultMaxSegments;

    /// <summary>
    /// How long timelines are kept beyond the lateness limit of events, 0 to 60 s; default 0. For programs that compare settled states.
    /// Cost: memory, as for the history of <see cref="LatencyCompensationWindow"/>.
    /// </summary>
    public SimDuration ExtraHistory { get; init; }

    /// <summary>
    /// How much of the past a render snapshot covers, 0 to 60 s; default 250 ms. It counts back from the displayed time: with
    /// <see cref="LateEventStrategy.Interpolation"/> a snapshot reaches <see cref="DisplayDelay"/> further back, and timelines are kept
    /// that much longer.
    /// </summary>
    public SimDuration RenderedPast { get; init; } = LiveWorld.DefaultRenderedPast;

    /// <summary>How long a peer may be silent before it is given up, 100 ms to 10 min; default 10 s.</summary>
    /// <remarks>
    /// A host then disconnects a client and reserves its number for <see cref="RejoinTime"/>; a client asks that long to be let in again. A
    /// client that is this far behind the log gets a fresh snapshot instead.
    /// </remarks>
    public SimDuration Timeout { get; init; } = DefaultTimeout;

    /// <summary>
    /// How long a call of the scene's rules may take before the session ends because of it, 100 ms to 10 min of real time; default 10 s.
    /// </summary>
    /// <remarks>
    /// Then whatever the call asks of the world throws. If it still goes on for half as long again, the thread of a <see cref="PeerThread"/>
    /// is given up; on any other thread the call goes on, because nothing can end it. Time in which the process stands still does not
    /// count.
    /// </remarks>
    public SimDuration RuleTimeout { get; init; } = RuleWatchdog.DefaultLimit;

    /// <summary>
    /// How long data waits before it is sent again on a link that loses some, if no new data carries it, 1 ms to 1 s; default 30 ms.
    /// </summary>
    public SimDuration ResendInterval { get; init; } = SimDuration.FromMilliseconds(30);

    /// <summary>The longest pause between datagrams, 10 ms to a third of the timeout; default that third, but no more than 2 s.</summary>
    public SimDuration KeepAlive
    {
        get => keepAlive ?? (Timeout / 3 < MaxKeepAlive ? Timeout / 3 : MaxKeepAlive);
        init => keepAlive = value;
    }

    /// <summary>
    /// Receives contacts, for a sound or a score; null, the default, for none. An instance serves one session only. Contacts are confirmed
    /// once the watermark has passed, later by <see cref="ExtraHistory"/>.
    /// </summary>
    public ContactNotices? Contacts { get; init; }

    /// <summary>
    /// Receives crossings of sensors, for a goal or a checkpoint; null, the default, for none. An instance serves one session only.
    /// Crossings are confirmed as contacts are.
    /// </summary>
    public CrossingNotices? Crossings { get; init; }

    /// <summary>
    /// Receives which bodies left the world because they cannot be followed any further; null, the default, for none. An instance serves one
    /// session only. Losses are confirmed as contacts are. What datagrams are lost is no matter of this.
    /// </summary>
    public LossNotices? Losses { get; init; }

    /// <summary>
    /// Receives what the scene's rules tell; null, the default, for none. An instance serves one session only. Confirmed as contacts are.
    /// </summary>
    public RuleNotices? RuleNotices { get; init; }

    /// <summary>
    /// How late events are handled; default <see cref="LateEventStrategy.Healing"/>. Peers with <see cref="LateEventStrategy.Healing"/>,
    /// <see cref="LateEventStrategy.FullRollback"/> and <see cref="LateEventStrategy.Interpolation"/> agree bit for bit, so these may be
    /// mixed; a peer with another agrees with no other peer.
    /// </summary>
    public LateEventStrategy Strategy { get; init; } = LateEventStrategy.Healing;

    /// <summary>
    /// Whether to check every heal against a full rollback in a second world, bit for bit; default false. The first difference ends the
    /// session with a sentence that shows both versions.
    /// </summary>
    /// <remarks>
    /// It is for testing your own scene, and more than doubles the cost. Only with a strategy that heals:
    /// <see cref="LateEventStrategy.Healing"/> or <see cref="LateEventStrategy.Interpolation"/>.
    /// </remarks>
    public bool SyncTest { get; init; }

    /// <summary>
    /// How far behind shared time <see cref="LateEventStrategy.Interpolation"/> shows the world, 0 to 5 s; default 100 ms. Other strategies
    /// ignore it.
    /// </summary>
    /// <remarks>
    /// An event that arrives within that time appears without a jump, and this peer's own actions appear that much later. Frames read at
    /// <see cref="Session.DisplayTime"/>. Each peer may choose its own.
    /// </remarks>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>
    /// Whether a <see cref="PeerThread"/> that starts has the code compiled that events need; default true. Without it, the first event of
    /// its kind in a process may reach the other peers' worlds some hundredths of a second late.
    /// </summary>
    /// <remarks>
    /// It runs once per process and strategy, in memory, on a background thread, and takes some tenths of a second. A client asks to be let
    /// in that much later; a host does not wait for it, and answers from the start. With ahead-of-time compilation, as by IL2CPP or native AOT, nothing is done. Sessions
    /// that are stepped without a <see cref="PeerThread"/> are not affected.
    /// </remarks>
    public bool Warmup { get; init; } = true;

    /// <summary>
    /// Aborts the session from any thread, even in the middle of a simulation step: <see cref="Session.Step"/> then throws an
    /// <see cref="OperationCanceledException"/>, and so does every later step until the session has ended; default none.
    /// </summary>
    /// <remarks>
    /// Other peers are not notified: <see cref="Session.Leave"/> says goodbye, or <see cref="PeerThread.Dispose"/> for a
    /// <see cref="PeerThread"/>, whose thread ends with that exception. The token keeps the session from being collected until it has
    /// ended.
    /// </remarks>
    public CancellationToken Cancellation { get; init; }

    /// <summary>
    /// Why a text cannot be a <see cref="Name"/>, as the rest of a sentence; null if it can. From any thread.
    /// </summary>
    /// <remarks>
    /// A name holds no control characters, and no character that shows nothing: none that changes the direction of text, no separators and
    /// blanks but the plain space, nothing of zero width, no U+FFFD; it neither begins nor ends with a blank, and has no two in a row. No
    /// number in it stands by itself, as in <c>2</c>, <c>2-</c> or <c>Ann, 2 player Bob</c>, since that reads as a player's number; <c>Ann2</c>, <c>Ann-2</c> and <c>2nd</c> can be names.
    /// </remarks>
    /// <exception cref="ArgumentNullException">The text is null.</exception>
    public static string? WhyNoName(string name) => PlayerName.WhyNone(name ?? throw new ArgumentNullException(nameof(name)));

    /// <summary>How late an event may be at the most.</summary>
    internal virtual SimDuration MostLateness => Window.History;

    /// <summary>Whether datagrams are encrypted and authenticated.</summary>
    internal abstract bool IsProtected { get; }

    /// <summary>The type's name only: keys are secret and must not end up in a log.</summary>
    public sealed override string ToString() => GetType().Name;

    /// <summary>Throws if a value is not allowed.</summary>
    internal virtual void Check()
    {
        Range(ExtraHistory, 0, 60, nameof(ExtraHistory));
        Range(RenderedPast, 0, 60, nameof(RenderedPast));
        Range(DisplayDelay, 0, Interpolation.MaxDelay.ToSeconds(), nameof(DisplayDelay));
        Range(RejoinTime, 0, 3600, nameof(RejoinTime));
        Range(Timeout, 0.1, 600, nameof(Timeout));
        Range(ResendInterval, 0.001, 1, nameof(ResendInterval));
        if (keepAlive is SimDuration given && (given < SimDuration.FromSeconds(0.01) || given > Timeout / 3))
        {
            throw new ArgumentOutOfRangeException(
                nameof(KeepAlive),
                given.ToShortString(),
                $"{nameof(KeepAlive)} must lie between 10 ms and a third of the timeout of {Timeout.ToShortString()}.");
        }

        Range(RuleTimeout, RuleWatchdog.MinLimit.ToSeconds(), RuleWatchdog.MaxLimit.ToSeconds(), nameof(RuleTimeout));
        Range(CommitInterval, 0.1, 60, nameof(CommitInterval));
        if (Window is null)
        {
            throw new ArgumentException("The window may not be null.", nameof(Window));
        }

        if (MaxSegments < 1)
        {
            throw new ArgumentOutOfRangeException(nameof(MaxSegments), MaxSegments, "The timelines must be allowed one segment at least.");
        }

        if (ConnectKey is null)
        {
            throw new ArgumentException("The connect key may be empty, but not null.", nameof(ConnectKey));
        }

        if (ConnectKey.Length > MaxKeyLength)
        {
            throw new ArgumentOutOfRangeException(
                nameof(ConnectKey), $"{ConnectKey.Length} characters", $"A connect key has 0 to {MaxKeyLength} characters.");
        }

        if (ConnectKeyText.WhyNone(ConnectKey) is string unfit)
        {
            throw new ArgumentException($"The connect key {unfit}", nameof(ConnectKey));
        }

        if (Name is null)
        {
            throw new ArgumentException("A peer's name may be empty, but not null.", nameof(Name));
        }

        if (PlayerName.WhyNone(Name) is string why)
        {
            throw new ArgumentException($"The peer's name is not one to show: {why}", nameof(Name));
        }

        if (Role is < PeerRole.Player or > PeerRole.Bot)
        {
            throw new ArgumentOutOfRangeException(nameof(Role), (int)Role, "A peer is a player, a spectator or a bot.");
        }

        if (!(MaxGivenSpeed > 0))
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxGivenSpeed), MaxGivenSpeed, "The highest speed that a player may give is above 0 m/s.");
        }

        if (!(MaxHandForce >= 0))
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxHandForce), MaxHandForce, "The greatest force of a player's hand is a number above 0 N, infinity too, or 0 for what a hand has by default.");
        }

        if (!(MaxHandPower >= 0))
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxHandPower), MaxHandPower, "The greatest power of a player's hand is a number above 0 W, infinity too, or 0 for what a hand has by default.");
        }

        if (MaxSpawned is < 0 or > 1_000_000)
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxSpawned), MaxSpawned, "The number of spawned bodies that a player may have in the world at once is 0 to 1,000,000.");
        }
    }

    private protected static void Range(SimDuration value, double least, double most, string name)
    {
        if (value < SimDuration.FromSeconds(least) || value > SimDuration.FromSeconds(most))
        {
            throw new ArgumentOutOfRangeException(
                name,
                value.ToShortString(),
                $"{name} must lie between {Seconds(least)} and {Seconds(most)}.");
        }
    }

    // To a tick, as the value beside it.
    private static string Seconds(double seconds) => SimDuration.FromSeconds(seconds).ToShortString().TrimEnd('s') + " s";
}
