using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Hosting;
using LagSim.Net.Sessions.Hosts;
using LagSim.Net.Strategies;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>How a peer takes part in a session. Checked when the session is made, with a sentence that tells what is allowed.</summary>
public sealed class SessionOptions
{
    /// <summary>How long a silent peer is believed to be there, where nothing else is said: 10 s.</summary>
    public static readonly SimDuration DefaultTimeout = SimDuration.FromSeconds(10);

    /// <summary>The most clients a host can have.</summary>
    public const int MaxClients = 8;

    /// <summary>The longest <see cref="ConnectKey"/>, in characters.</summary>
    public const int MaxKeyLength = 256;

    private static readonly SimDuration MostKeepAlive = SimDuration.FromSeconds(2);

    private SimDuration? keepAlive;
    private int? perAddress;

    /// <summary>
    /// What only those may know who shall join; the host refuses any other. Up to <see cref="MaxKeyLength"/> characters, default none. It
    /// does not travel, and it keeps strangers out; it does not encrypt. Take a long random one: who listens, or plays a host, gets what guesses can be
    /// tried against without asking anybody, and no host shows a client that it knows the key.
    /// </summary>
    public string ConnectKey { get; set; } = "";

    /// <summary>
    /// Host only: keys of players by number, 1 to <see cref="MaxClients"/>; default none. Who gives such a key as its <see cref="ConnectKey"/> has that number,
    /// whenever it comes, and takes it over from whoever still holds it; nobody else gets it. Without, numbers go by order of arrival and are given
    /// again, and with them what a scene grants to a number.
    /// </summary>
    public IReadOnlyDictionary<byte, string> PlayerKeys { get; set; } = new Dictionary<byte, string>();

    /// <summary>
    /// Client only: what shows the host that this is a player it had before, from <see cref="ClientSession.Pass"/> of then; default none. With one a client asks for
    /// <see cref="RejoinTime"/> to be let in, as one does that lost its host. A host that does not know it, or no longer, gives the client a number as it gives
    /// anybody; one that was started anew the same number, if it is free: without proof, and for its first <see cref="RejoinTime"/> alone.
    /// </summary>
    public PlayerPass Pass { get; set; }

    /// <summary>
    /// For how long a client that lost its host, or its world, asks to be let in again before its session ends; and for how long a host keeps the number of a
    /// client that fell silent, where nobody else needs it. 0 s to 1 h; default 2 min. With 0 a client's session ends at once.
    /// </summary>
    public SimDuration RejoinTime { get; set; } = SimDuration.FromSeconds(120);

    /// <summary>
    /// Host only: how many clients may be in from one address, whatever their ports, 1 to <see cref="MaxClients"/>; default half of the places, or <see
    /// cref="ExpectedClients"/> if that is more. So nobody takes all places from one machine. Players behind one NAT share an address.
    /// </summary>
    public int MaxClientsPerAddress
    {
        get => perAddress ?? Math.Max(MaxClients / 2, ExpectedClients);
        set => perAddress = value;
    }

    /// <summary>Client only: the accelerations that this program can supply to a scene that it gets from the host; default none.</summary>
    public IReadOnlyList<IAcceleration>? Accelerations { get; set; }

    /// <summary>Host only: how many events a second it takes from each client, 1 to 100,000; default 500. What is more is taken later. Thousands need a larger <see cref="PlayerBudget"/>, or none.</summary>
    public int MaxEventsPerSecond { get; set; } = 500;

    /// <summary>
    /// The highest speed in m/s that an event of a player may give, above 0, up to <see cref="double.PositiveInfinity"/> for no limit beyond the world's own;
    /// default 1,000. It holds for the velocity of a spawn, a teleport, a set velocity, a keyframe or a release, for the surface of a spawn that turns, for the way
    /// that a keyframe has a held body make up for, and for what an impulse leaves, unless that is slower than what was there. A host refuses more as <see
    /// cref="Verdict.Invalid"/>, by its own option; a client's own <see cref="Session.Do"/> goes by the client's.
    /// </summary>
    /// <remarks>It is what keeps a stranger from asking the world for more than anyone can simulate: a fast ball in a narrow gap.</remarks>
    public double MaxGivenSpeed { get; set; } = 1_000;

    /// <summary>
    /// How many bodies that one player spawned may be there at a time, 0 to 1,000,000; default 64. Those of the former holders of a client's number count. A
    /// host refuses more as <see cref="Verdict.NoRight"/>, by its own option; a client's own <see cref="Session.Do"/> goes by the client's.
    /// </summary>
    public int MaxSpawned { get; set; } = 64;

    /// <summary>
    /// Host only: what a player's acts may cost, in work to simulate what comes of them; default <see cref="PlayerBudget.Default"/>, and null for no limit. Who has used up half of it
    /// has its acts refused (<see cref="Verdict.NoRight"/>) but for removals and releases; who has used it up is sent away as by <see cref="HostSession.Kick"/>, nobody is
    /// let in from its machine for a minute, what it spawned is removed as of before the work began, and what else it moved and much of the work was for is stopped. See <see
    /// cref="HostSession.PlayerExpelled"/>. While the world is 150 ms late, half of it is all there is.
    /// </summary>
    /// <remarks>
    /// An event on a body in free flight that comes late counts 12 units and more. The default of <see cref="MaxEventsPerSecond"/> is far from the budget; who permits thousands a second
    /// raises it in proportion.
    /// </remarks>
    public PlayerBudget? PlayerBudget { get; set; } = PlayerBudget.Default;

    /// <summary>How much time lies between two committed states that are hashed, 100 ms to 60 s; default 1 s. The same on all peers, to be compared.</summary>
    public SimDuration CommitInterval { get; set; } = SimDuration.FromSeconds(1);

    /// <summary>
    /// How late an event may be and still be accepted, how far ahead the world is simulated, and how much later than it is done what this peer does is to
    /// happen. The history is the host's, whatever a client says.
    /// </summary>
    public LatencyCompensationWindow Window { get; set; } = new();

    /// <summary>
    /// How many segments all timelines of this peer may hold together, from 1; default <see cref="SimulationOptions.DefaultMaxSegments"/>. A peer that needs
    /// more says so and leaves (<see cref="SessionEnd.TimelinesFull"/>), and can join again: it then gets the world as it is committed.
    /// </summary>
    public int MaxSegments { get; set; } = SimulationOptions.DefaultMaxSegments;

    /// <summary>
    /// How many threads at most may be at work for this peer's world at once, as <see cref="SimulationOptions.Threads"/>: 1 to
    /// <see cref="SceneBuilder.MaxThreads"/>; null, the default, for its default. Each peer's own: no bit depends on it.
    /// </summary>
    public int? Threads { get; set; }

    /// <summary>How much longer timelines are kept than events may be late, 0 to 60 s; default 0. For those who compare settled states.</summary>
    public SimDuration ExtraHistory { get; set; }

    /// <summary>
    /// How much of the past render snapshots show, 0 to 60 s; default 250 ms. It is counted from what is displayed: with <c>interpolation</c> render snapshots go back by
    /// <see cref="DisplayDelay"/> more, and as much more of the timelines is kept.
    /// </summary>
    public SimDuration RenderedPast { get; set; } = LiveWorld.DefaultRenderedPast;

    /// <summary>Host only: how many clients the start waits for, 0 to 8; default 0. Before the start there is no world, and nothing can be done.</summary>
    public int ExpectedClients { get; set; }

    /// <summary>Host only: how long after all expected clients are ready the scene starts, 0 to 60 s; default 500 ms.</summary>
    public SimDuration StartLead { get; set; } = SimDuration.FromMilliseconds(500);

    /// <summary>
    /// After how much silence a peer is given up, 100 ms to 10 min; default 10 s. A host disconnects a client then, and keeps its number for <see cref="RejoinTime"/>; a
    /// client asks for as long to be let in again. So long, too, a client may be behind the log before it gets a fresh copy instead.
    /// </summary>
    public SimDuration Timeout { get; set; } = DefaultTimeout;

    /// <summary>How long what is not acknowledged waits before it is sent again, 1 ms to 1 s; default 30 ms.</summary>
    public SimDuration ResendInterval { get; set; } = SimDuration.FromMilliseconds(30);

    /// <summary>How long nothing is sent at most, 10 ms to a third of the timeout; default that third, but no more than 2 s.</summary>
    public SimDuration KeepAlive
    {
        get => keepAlive ?? (Timeout / 3 < MostKeepAlive ? Timeout / 3 : MostKeepAlive);
        set => keepAlive = value;
    }

    /// <summary>
    /// What is told of contacts, for a sound or a score; null, the default: nobody. Of one session alone. Contacts are confirmed once the watermark has passed,
    /// later by <see cref="ExtraHistory"/>.
    /// </summary>
    public ContactNotices? Contacts { get; set; }

    /// <summary>The name of what to do with late events, one of <see cref="LateEventStrategies.Names"/>.</summary>
    public string Strategy { get; set; } = LateEventStrategies.Default;

    /// <summary>
    /// Whether every late event is healed and also fully rolled back in a second world, and every bit of the two compared; default false. The first difference
    /// ends the session with a sentence that names it in both versions. To test a scene of one's own: it costs more than twice as much. With a strategy that
    /// heals alone: <c>healing</c> or <c>interpolation</c>.
    /// </summary>
    public bool SyncTest { get; set; }

    /// <summary>
    /// How far behind shared time <c>interpolation</c> shows the world, 0 to 5 s; default 100 ms. No other strategy looks at it. An event that comes within that
    /// time is seen without a jump, and what this peer does itself is seen that much later. A frame reads at <see cref="Session.DisplayTime"/>. Each peer may
    /// have another.
    /// </summary>
    public SimDuration DisplayDelay { get; set; } = Interpolation.DefaultDelay;

    /// <summary>
    /// Whether a <see cref="PeerThread"/> has what events need compiled before it steps its session for the first time; default true. Without, the first event of its
    /// kind in a process may take some hundredths of a second to the other peers' worlds. It is done once a process and strategy, in memory, on the session's
    /// thread, and takes some tenths of a second there; the session begins that much later, and nothing in it is another for it. Where everything is compiled
    /// ahead, as by IL2CPP or native AOT, nothing is done. Who steps a session without such a thread is not affected.
    /// </summary>
    public bool Warmup { get; set; } = true;

    /// <summary>
    /// Ends from any thread whatever the session is at, the simulating of its world included, between two instants: <see cref="Session.Step"/> then throws an
    /// <see cref="OperationCanceledException"/>, and every later one too, until the session has ended; default none. Nobody is told: <see cref="Session.Leave"/> says goodbye, and of a
    /// <see cref="PeerThread"/>, whose thread ends by that exception, <see cref="PeerThread.Dispose"/>. The token keeps the session from being collected until that has ended.
    /// </summary>
    public CancellationToken Cancellation { get; set; }

    /// <summary>Host only: what those who are coming in can have.</summary>
    internal DoorLimits Door { get; set; } = new();

    internal void Check()
    {
        Range(ExtraHistory, 0, 60, nameof(ExtraHistory));
        Range(RenderedPast, 0, 60, nameof(RenderedPast));
        Range(DisplayDelay, 0, Interpolation.MaxDelay.ToSeconds(), nameof(DisplayDelay));
        Range(StartLead, 0, 60, nameof(StartLead));
        Range(RejoinTime, 0, 3600, nameof(RejoinTime));
        Range(Timeout, 0.1, 600, nameof(Timeout));
        Range(ResendInterval, 0.001, 1, nameof(ResendInterval));
        if (keepAlive is SimDuration given)
        {
            Range(given, 0.01, Timeout.ToSeconds() / 3, nameof(KeepAlive));
        }

        if (Window is null)
        {
            throw new ArgumentException("The window may not be null.", nameof(Window));
        }

        if (MaxSegments < 1)
        {
            throw new ArgumentOutOfRangeException(nameof(MaxSegments), MaxSegments, "The timelines must be allowed one segment at least.");
        }

        if (Threads is < 1 or > SceneBuilder.MaxThreads)
        {
            throw new ArgumentOutOfRangeException(nameof(Threads), Threads, $"One thread is at work at least, and {SceneBuilder.MaxThreads} at most.");
        }

        Range(CommitInterval, 0.1, 60, nameof(CommitInterval));
        if (ConnectKey is null || PlayerKeys is null)
        {
            throw new ArgumentException(
                "The connect key and the players' keys may be empty, but not null.", ConnectKey is null ? nameof(ConnectKey) : nameof(PlayerKeys));
        }

        if (ConnectKey.Length > MaxKeyLength)
        {
            throw new ArgumentOutOfRangeException(nameof(ConnectKey), $"{ConnectKey.Length} characters", $"A connect key has 0 to {MaxKeyLength} characters.");
        }

        foreach (KeyValuePair<byte, string> player in PlayerKeys)
        {
            if (player.Key is 0 or > MaxClients || string.IsNullOrEmpty(player.Value) || player.Value.Length > MaxKeyLength)
            {
                throw new ArgumentOutOfRangeException(
                    nameof(PlayerKeys), $"{player.Value?.Length ?? 0} characters for player {player.Key}", $"Players 1 to {MaxClients} can have keys, each of"
                        + $" 1 to {MaxKeyLength} characters.");
            }
        }

        if (PlayerKeys.Values.Append(ConnectKey).Distinct().Count() != PlayerKeys.Count + 1)
        {
            throw new ArgumentException("Two players have the same key, or one the connect key; each must have another.", nameof(PlayerKeys));
        }

        if (MaxEventsPerSecond is < 1 or > 100_000)
        {
            throw new ArgumentOutOfRangeException(nameof(MaxEventsPerSecond), MaxEventsPerSecond, "A host takes 1 to 100,000 events a second from a joiner.");
        }

        if (!(MaxGivenSpeed > 0))
        {
            throw new ArgumentOutOfRangeException(nameof(MaxGivenSpeed), MaxGivenSpeed, "The highest speed that a player may give is above 0 m/s.");
        }

        if (MaxSpawned is < 0 or > 1_000_000)
        {
            throw new ArgumentOutOfRangeException(nameof(MaxSpawned), MaxSpawned, "A player may have spawned 0 to 1,000,000 bodies that are there.");
        }

        if (perAddress is < 1 or > MaxClients)
        {
            throw new ArgumentOutOfRangeException(nameof(MaxClientsPerAddress), perAddress, $"From one address 1 to {MaxClients} joiners may be in.");
        }

        if (ExpectedClients is < 0 or > MaxClients)
        {
            throw new ArgumentOutOfRangeException(nameof(ExpectedClients), ExpectedClients, $"A host waits for 0 to {MaxClients} joiners.");
        }
    }

    private static void Range(SimDuration value, double least, double most, string name)
    {
        if (value < SimDuration.FromSeconds(least) || value > SimDuration.FromSeconds(most))
        {
            throw new ArgumentOutOfRangeException(name, value.ToShortString(), FormattableString.Invariant($"{name} must lie between {least} s and {most} s."));
        }
    }
}
