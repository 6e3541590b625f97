using System;
using System.Threading;
using LagSim.Hosting;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>
/// What hosts and clients both are told of how to take part: <see cref="HostOptions"/> and <see cref="ClientOptions"/> add their own.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread; <c>with</c> makes a changed copy. Values are validated when a session is made, with a sentence that names
/// the value and what is allowed.
/// </remarks>
public abstract record SessionOptions
{
    /// <summary>How long a silent peer is believed to be there, where nothing else is said: 10 s.</summary>
    public static readonly SimDuration DefaultTimeout = SimDuration.FromSeconds(10);

    /// <summary>The most clients a host can have.</summary>
    public const int MaxClients = 8;

    /// <summary>The longest <see cref="ConnectKey"/>, in characters.</summary>
    public const int MaxKeyLength = 256;

    private static readonly SimDuration MostKeepAlive = SimDuration.FromSeconds(2);

    private readonly SimDuration? keepAlive;

    private protected SessionOptions()
    {
    }

    /// <summary>
    /// The shared secret: a host requires it, and a client presents it. Up to <see cref="MaxKeyLength"/> characters, default none. It does
    /// not travel.
    /// </summary>
    /// <remarks>
    /// It keeps strangers out; it does not encrypt. Take a long random one: who listens, or plays a host, gets what guesses can be tried
    /// against without asking anybody, and no host shows a client that it knows the key.
    /// </remarks>
    public string ConnectKey { get; init; } = "";

    /// <summary>
    /// For how long a client that lost its host, or its world, asks to be let in again before its session ends; and for how long a host
    /// keeps the number of a client that fell silent, where nobody else needs it. 0 s to 1 h; default 2 min. With 0 a client's session ends
    /// at once.
    /// </summary>
    public SimDuration RejoinTime { get; init; } = SimDuration.FromSeconds(120);

    /// <summary>
    /// The highest speed in m/s that an event of a player may give, above 0, up to <see cref="double.PositiveInfinity"/> for no limit
    /// beyond the world's own; default 1,000. It holds for the velocity of a spawn, a teleport, a set velocity, a keyframe or a release,
    /// for the surface of a spawn that turns, for the way that a keyframe has a held body make up for, and for what an impulse leaves,
    /// unless that is slower than what was there. A host refuses more as <see cref="Wire.Verdict.Invalid"/>, by its own option; a client's
    /// own <see cref="Session.Do"/> goes by the client's.
    /// </summary>
    /// <remarks>It is what keeps a stranger from asking the world for more than anyone can simulate: a fast ball in a narrow gap.</remarks>
    public double MaxGivenSpeed { get; init; } = 1_000;

    /// <summary>
    /// How many bodies that one player spawned may be there at a time, 0 to 1,000,000; default 64. Those of the former holders of a
    /// client's number count. A host refuses more as <see cref="Wire.Verdict.NoRight"/>, by its own option; a client's own
    /// <see cref="Session.Do"/> goes by the client's.
    /// </summary>
    public int MaxSpawned { get; init; } = 64;

    /// <summary>
    /// How much time lies between two committed states that are hashed, 100 ms to 60 s; default 1 s. The same on all peers, to be compared.
    /// </summary>
    public SimDuration CommitInterval { get; init; } = SimDuration.FromSeconds(1);

    /// <summary>
    /// How late an event may be and still be accepted, how far ahead the world is simulated, and how much later than it is done what this
    /// peer does is to happen. The history is the host's, whatever a client says.
    /// </summary>
    public LatencyCompensationWindow Window { get; init; } = new();

    /// <summary>
    /// How many segments all timelines of this peer may hold together, from 1; default <see cref="SimulationOptions.DefaultMaxSegments"/>.
    /// A peer that needs more says so and leaves (<see cref="SessionEnd.TimelinesFull"/>), and can join again: it then gets the world as it
    /// is committed.
    /// </summary>
    public int MaxSegments { get; init; } = SimulationOptions.DefaultMaxSegments;

    /// <summary>
    /// How many threads at most may be at work for this peer's world at once, as <see cref="SimulationOptions.Threads"/>: 1 to
    /// <see cref="SceneBuilder.MaxThreads"/>; null, the default, for its default. Each peer's own: no bit depends on it.
    /// </summary>
    public int? Threads { get; init; }

    /// <summary>
    /// How much longer timelines are kept than events may be late, 0 to 60 s; default 0. For those who compare settled states. Cost:
    /// memory, as <see cref="LatencyCompensationWindow"/> has it for the history.
    /// </summary>
    public SimDuration ExtraHistory { get; init; }

    /// <summary>
    /// How much of the past render snapshots show, 0 to 60 s; default 250 ms. It is counted from what is displayed: with
    /// <see cref="LateEventStrategy.Interpolation"/> render snapshots go back by <see cref="DisplayDelay"/> more, and as much more of the
    /// timelines is kept.
    /// </summary>
    public SimDuration RenderedPast { get; init; } = LiveWorld.DefaultRenderedPast;

    /// <summary>
    /// After how much silence a peer is given up, 100 ms to 10 min; default 10 s. A host disconnects a client then, and keeps its number
    /// for <see cref="RejoinTime"/>; a client asks for as long to be let in again. So long, too, a client may be behind the log before it
    /// gets a fresh copy instead.
    /// </summary>
    public SimDuration Timeout { get; init; } = DefaultTimeout;

    /// <summary>How long what is not acknowledged waits before it is sent again, 1 ms to 1 s; default 30 ms.</summary>
    public SimDuration ResendInterval { get; init; } = SimDuration.FromMilliseconds(30);

    /// <summary>How long nothing is sent at most, 10 ms to a third of the timeout; default that third, but no more than 2 s.</summary>
    public SimDuration KeepAlive
    {
        get => keepAlive ?? (Timeout / 3 < MostKeepAlive ? Timeout / 3 : MostKeepAlive);
        init => keepAlive = value;
    }

    /// <summary>
    /// What is told of contacts, for a sound or a score; null, the default: nobody. Of one session alone. Contacts are confirmed once the
    /// watermark has passed, later by <see cref="ExtraHistory"/>.
    /// </summary>
    public ContactNotices? Contacts { get; init; }

    /// <summary>
    /// What to do with late events; default <see cref="LateEventStrategy.Healing"/>. Peers with <see cref="LateEventStrategy.Healing"/>,
    /// <see cref="LateEventStrategy.FullRollback"/> and <see cref="LateEventStrategy.Interpolation"/> agree bit for bit, so these may be
    /// mixed; a peer with another agrees with no other peer.
    /// </summary>
    public LateEventStrategy Strategy { get; init; } = LateEventStrategy.Healing;

    /// <summary>
    /// Whether every late event is healed and also fully rolled back in a second world, and every bit of the two compared; default false.
    /// The first difference ends the session with a sentence that names it in both versions. To test a scene of one's own: it costs more
    /// than twice as much. With a strategy that heals alone: <see cref="LateEventStrategy.Healing"/> or
    /// <see cref="LateEventStrategy.Interpolation"/>.
    /// </summary>
    public bool SyncTest { get; init; }

    /// <summary>
    /// How far behind shared time <see cref="LateEventStrategy.Interpolation"/> shows the world, 0 to 5 s; default 100 ms. No other
    /// strategy looks at it. An event that comes within that time is seen without a jump, and what this peer does itself is seen that much
    /// later. A frame reads at <see cref="Session.DisplayTime"/>. Each peer may have another.
    /// </summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>
    /// Whether a <see cref="PeerThread"/> has what events need compiled before it steps its session for the first time; default true.
    /// Without, the first event of its kind in a process may take some hundredths of a second to the other peers' worlds. It is done once a
    /// process and strategy, in memory, on the session's thread, and takes some tenths of a second there; the session begins that much
    /// later, and nothing in it is another for it. Where everything is compiled ahead, as by IL2CPP or native AOT, nothing is done. Who
    /// steps a session without such a thread is not affected.
    /// </summary>
    public bool Warmup { get; init; } = true;

    /// <summary>
    /// Ends from any thread whatever the session is at, the simulating of its world included, between two instants:
    /// <see cref="Session.Step"/> then throws an <see cref="OperationCanceledException"/>, and every later one too, until the session has
    /// ended; default none. Nobody is told: <see cref="Session.Leave"/> says goodbye, and of a <see cref="PeerThread"/>, whose thread ends
    /// by that exception, <see cref="PeerThread.Dispose"/>. The token keeps the session from being collected until that has ended.
    /// </summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>The type's name alone: keys are secret, and do not belong in a log.</summary>
    public sealed override string ToString() => GetType().Name;

    /// <summary>Throws for what is not allowed.</summary>
    internal virtual void Check()
    {
        Range(ExtraHistory, 0, 60, nameof(ExtraHistory));
        Range(RenderedPast, 0, 60, nameof(RenderedPast));
        Range(DisplayDelay, 0, Interpolation.MaxDelay.ToSeconds(), nameof(DisplayDelay));
        Range(RejoinTime, 0, 3600, nameof(RejoinTime));
        Range(Timeout, 0.1, 600, nameof(Timeout));
        Range(ResendInterval, 0.001, 1, nameof(ResendInterval));
        if (keepAlive is SimDuration given)
        {
            Range(given, 0.01, Timeout.ToSeconds() / 3, nameof(KeepAlive));
        }

        Range(CommitInterval, 0.1, 60, nameof(CommitInterval));
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
            throw new ArgumentOutOfRangeException(
                nameof(Threads), Threads, $"One thread is at work at least, and {SceneBuilder.MaxThreads} at most.");
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

        if (!(MaxGivenSpeed > 0))
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxGivenSpeed), MaxGivenSpeed, "The highest speed that a player may give is above 0 m/s.");
        }

        if (MaxSpawned is < 0 or > 1_000_000)
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxSpawned), MaxSpawned, "A player may have spawned 0 to 1,000,000 bodies that are there.");
        }
    }

    private protected static void Range(SimDuration value, double least, double most, string name)
    {
        if (value < SimDuration.FromSeconds(least) || value > SimDuration.FromSeconds(most))
        {
            throw new ArgumentOutOfRangeException(
                name,
                value.ToShortString(),
                $"{name} must lie between {SimDuration.FromSeconds(least).ToShortString()} and {SimDuration.FromSeconds(most).ToShortString()}.");
        }
    }
}
