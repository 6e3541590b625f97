using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Protection;
using LagSim.Net.Sessions.Hosts;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>
/// How a host takes part: which clients it lets in, what players may cost, and the <see cref="SessionOptions"/> of every peer.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread. Validated when the session is made, with an exception that names the value and what is allowed.
/// </remarks>
/// <example>
/// A host for two players who know a secret, and may be 400 ms late:
/// <code>
/// HostOptions options = new()
/// {
///     ConnectKey = "correct horse battery staple",
///     ExpectedClients = 2,
///     Window = new LatencyCompensationWindow(history: SimDuration.FromMilliseconds(400)),
///     Unprotected = true, // or a Protection
/// };
/// using PeerThread host = PeerThread.Host(scene, udpPort: 5000, options, setUp: session =&gt;
///     session.ClientCame += link =&gt; Console.WriteLine($"player {link.Peer} is in"));
/// </code>
/// </example>
public sealed record HostOptions : SessionOptions
{
    private static readonly IReadOnlyDictionary<byte, string> NoKeys = new Dictionary<byte, string>();

    private readonly int? perAddress;
    private readonly SimDuration? longest;
    private readonly IReadOnlyDictionary<byte, string>? playerKeys = NoKeys;

    /// <summary>Creates the defaults: the session begins at once, and clients may join at any time.</summary>
    public HostOptions()
    {
    }

    private HostOptions(SessionOptions common)
        : base(common)
    {
    }

    /// <summary>
    /// Keys of players by number, 1 to <see cref="SessionOptions.MaxClients"/>; default none. A client that presents such a key as its
    /// <see cref="SessionOptions.ConnectKey"/> always gets that number, taking it over from any client that holds it; no other client gets
    /// it.
    /// </summary>
    /// <remarks>
    /// Without keys, numbers go by order of arrival, those that nobody has had first, and are reused. One to which the scene grants something
    /// is reused at once, with what it grants. The dictionary is copied: later changes to it have no effect.
    /// </remarks>
    public IReadOnlyDictionary<byte, string> PlayerKeys
    {
        get => playerKeys!;
        init => playerKeys = value is null ? null : new Dictionary<byte, string>(value);
    }

    /// <summary>
    /// How many clients may be in from one address, whatever their ports, 1 to <see cref="SessionOptions.MaxClients"/>; default half of the
    /// places, or <see cref="ExpectedClients"/> if that is more.
    /// </summary>
    /// <remarks>It keeps one machine from taking every place. Players behind one NAT share an address.</remarks>
    public int MaxClientsPerAddress
    {
        get => perAddress ?? Math.Max(MaxClients / 2, ExpectedClients);
        init => perAddress = value;
    }

    /// <summary>
    /// How many spectators may be in, 0 to <see cref="SessionOptions.MaxSpectators"/>; default all of these. They take no player's place.
    /// </summary>
    /// <remarks><see cref="MaxClientsPerAddress"/> limits them too, apart from the players.</remarks>
    public int SpectatorPlaces { get; init; } = MaxSpectators;

    /// <summary>
    /// Whether what lies in the past becomes final as soon as the links of the players allow, rather than a history later; default false.
    /// </summary>
    /// <remarks>
    /// <para>Clients then promise, at least each 50 ms, to stamp nothing before an instant any more. What all have promised is final: about
    /// a round trip of the slowest player and a tenth of a second later, never later than without this, and at once where nobody else
    /// plays. No event of an honest client is refused that would not be without this.</para>
    /// <para>Cost: some 20 datagrams a second in both directions of each link, 2 to 3 KB/s with headers. What was done cannot be taken
    /// back as far: <see cref="PlayerBudget"/> undoes less of what an expelled player did. What is final is forgotten, see
    /// <see cref="SessionOptions.ExtraHistory"/>.</para>
    /// </remarks>
    public bool ConfirmsEarly { get; init; }

    /// <summary>
    /// How late an event may be at the most, while a player's events are on their way: from the history of
    /// <see cref="SessionOptions.Window"/>, for no longer than that, to <see cref="LatencyCompensationWindow.MaxHistory"/>; default three times
    /// the history, but no more than that.
    /// </summary>
    /// <remarks>
    /// <para>A player that acts tells with each update, and at least four times in a history, before which instant it stamps nothing any
    /// more. While that stays out the link holds its events back, and nothing later than it becomes final until they come, or this bound is
    /// reached. One that has done nothing for ten seconds makes no promises: it is waited for by the round trip of its link.</para>
    /// <para>Cost: nothing while all are heard but four small datagrams a second of a player that acts seldom, for ten seconds after it.
    /// While one is waited for, what happens is final that much later, and every peer keeps as much more of the past: memory as for the
    /// history of the window. A player that withholds its updates on purpose costs all others no more than that. What is later still is
    /// refused as <see cref="Wire.Verdict.TooLate"/>, or happens later: <see cref="Wire.Verdict.Moved"/>.</para>
    /// </remarks>
    public SimDuration LongestHistory
    {
        get => longest ?? (Window.History * 3 < LatencyCompensationWindow.MaxHistory ? Window.History * 3 : LatencyCompensationWindow.MaxHistory);
        init => longest = value;
    }

    /// <summary>
    /// How many events per second are processed from each client, 1 to 100,000; default 500. Excess events are deferred. Thousands need a
    /// larger <see cref="PlayerBudget"/>, or none.
    /// </summary>
    public int MaxEventsPerSecond { get; init; } = 500;

    /// <summary>
    /// How many bytes of updates per second the host sends to each client in the mean, UDP and IP headers included, 4,000 to 100,000,000;
    /// default null: as many as the events need and the link carries.
    /// </summary>
    /// <remarks>
    /// <para>Where events need more, nothing goes twice before it is known to be lost, and events wait for each other, so that datagrams are
    /// full. None is lost. If they need more even so, the client falls behind; as on a link that carries too little, it gets a fresh copy
    /// once it is a <see cref="SessionOptions.Timeout"/> behind, and its session ends as <see cref="SessionEnd.LinkTooSlow"/> if that does
    /// not help.</para>
    /// <para>Copies of the world for clients that join are not counted. On this machine's line everybody's share adds up.</para>
    /// </remarks>
    public int? MaxBytesPerSecond { get; init; }

    /// <summary>
    /// The simulation work that a player's actions may cause; default <see cref="PlayerBudget.Default"/>, null for no limit. See the
    /// remarks for what happens to a player that exceeds it.
    /// </summary>
    /// <remarks>
    /// <para>At half the budget, a player's actions are refused (<see cref="Wire.Verdict.NoRight"/>) except removals and releases. At the
    /// full budget the player is expelled as by <see cref="HostSession.Kick"/>, is told what it cost, and is not let in for a minute: by its
    /// token, its key or its pass. If another is expelled from its machine within ten minutes, nobody without token or key is let in from
    /// there for as long. What it spawned is removed as of before the work began, and other bodies it moved that caused much of the work are
    /// stopped; see <see cref="HostSession.PlayerExpelled"/>.</para>
    /// <para>Work is counted, not timed, so a machine that has little time for the host sends nobody away. What a game's rules compute counts
    /// as they say themselves (<see cref="Rules.RuleWorld.Charge"/>), and as nothing if they say nothing.</para>
    /// <para>A late event on a body in free flight counts some 5 units or more. The default <see cref="MaxEventsPerSecond"/> stays far from the
    /// budget; if you allow thousands a second, raise the budget in proportion.</para>
    /// </remarks>
    public PlayerBudget? PlayerBudget { get; init; } = PlayerBudget.Default;

    /// <summary>
    /// How many clients that play to wait for before the start, 0 to <see cref="SessionOptions.MaxClients"/>; default 0. Before the start
    /// there is no world, and no action is possible.
    /// </summary>
    public int ExpectedClients { get; init; }

    /// <summary>The delay between all expected clients being ready and the start of the scene, 0 to 60 s; default 500 ms.</summary>
    public SimDuration StartLead { get; init; } = SimDuration.FromMilliseconds(500);

    /// <summary>
    /// The host's identity and handshake: with it every datagram is encrypted and authenticated, and clients can tell this host from any
    /// other. Default null: the session is not protected, and anyone on the path can read, change and forge what is sent;
    /// <see cref="PeerThread"/> hosts such a one only if <see cref="Unprotected"/> says that it is meant.
    /// </summary>
    /// <remarks>Sessions may share one. The package <c>LagSim.Net.Secure</c> has it: <c>SecureHost</c>.</remarks>
    public IHostProtection? Protection { get; init; }

    /// <summary>
    /// Whether it is meant that nothing protects the session; default false. Without it <c>PeerThread.Host</c> refuses a session that has
    /// no <see cref="Protection"/>, unless it is bound to this machine alone or its network is virtual.
    /// </summary>
    public bool Unprotected { get; init; }

    internal override SimDuration MostLateness => LongestHistory;

    internal override bool IsProtected => Protection is not null;

    /// <summary>The limits on clients that are still joining.</summary>
    internal JoinLimits JoinLimits { get; init; } = new();

    /// <summary>
    /// Returns <paramref name="options"/> if they are a host's, otherwise host options with the same shared settings and defaults for the
    /// rest.
    /// </summary>
    /// <exception cref="ArgumentNullException">The options are null.</exception>
    public static HostOptions From(SessionOptions options) =>
        options as HostOptions ?? new HostOptions(options ?? throw new ArgumentNullException(nameof(options)));

    /// <summary>Refuses to host a session that nothing protects and that others can reach, unless it is meant.</summary>
    /// <exception cref="ArgumentException">It is not said.</exception>
    internal void ThrowIfUnprotectedUnawares()
    {
        if (!IsProtected && !Unprotected)
        {
            throw new ArgumentException(
                "Nothing protects this session: anyone on the path could read it, act in any player's name, and be its host. Set Protection"
                    + " (the package LagSim.Net.Secure has it: SecureHost), or Unprotected = true if it is meant to be so. A session for this"
                    + " machine alone, by bind: IPAddress.Loopback, needs neither.",
                nameof(Protection));
        }
    }

    internal override void Check()
    {
        base.Check();
        if (Unprotected && IsProtected)
        {
            throw new ArgumentException("The options have a protection, and say that the session is meant to have none.", nameof(Unprotected));
        }

        Range(StartLead, 0, 60, nameof(StartLead));
        if (LongestHistory < Window.History || LongestHistory > LatencyCompensationWindow.MaxHistory)
        {
            throw new ArgumentOutOfRangeException(
                nameof(LongestHistory), LongestHistory.ToShortString(), $"The longest history must lie between the window's of {Window.History.ToShortString()}"
                    + $" and {LatencyCompensationWindow.MaxHistory.ToShortString()}.");
        }

        CheckPlayerKeys();
        if (MaxEventsPerSecond is < 1 or > 100_000)
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxEventsPerSecond), MaxEventsPerSecond, "A host takes 1 to 100,000 events a second from a client.");
        }

        if (MaxBytesPerSecond is < 4_000 or > 100_000_000)
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxBytesPerSecond), MaxBytesPerSecond, "A host sends each client at most 4,000 to 100,000,000 bytes a second, or null for no limit.");
        }

        if (SpectatorPlaces is < 0 or > MaxSpectators)
        {
            throw new ArgumentOutOfRangeException(
                nameof(SpectatorPlaces), SpectatorPlaces, $"A host has places for 0 to {MaxSpectators} spectators.");
        }

        if (perAddress is < 1 or > MaxClients)
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxClientsPerAddress), perAddress, $"From one address 1 to {MaxClients} clients may be in.");
        }

        if (ExpectedClients is < 0 or > MaxClients)
        {
            throw new ArgumentOutOfRangeException(nameof(ExpectedClients), ExpectedClients, $"A host waits for 0 to {MaxClients} clients.");
        }
    }

    private void CheckPlayerKeys()
    {
        if (playerKeys is null)
        {
            throw new ArgumentException("The players' keys may be empty, but not null.", nameof(PlayerKeys));
        }

        foreach (KeyValuePair<byte, string> player in PlayerKeys)
        {
            if (player.Key is 0 or > MaxClients || string.IsNullOrEmpty(player.Value) || player.Value.Length > MaxKeyLength)
            {
                throw new ArgumentOutOfRangeException(
                    nameof(PlayerKeys),
                    $"{player.Value?.Length ?? 0} characters for player {player.Key}",
                    $"Players 1 to {MaxClients} can have keys, each of 1 to {MaxKeyLength} characters.");
            }
        }

        foreach (KeyValuePair<byte, string> player in PlayerKeys)
        {
            if (ConnectKeyText.WhyNone(player.Value) is string why)
            {
                throw new ArgumentException($"The key of player {player.Key} {why}", nameof(PlayerKeys));
            }
        }

        if (PlayerKeys.Values.Append(ConnectKey).Distinct().Count() != PlayerKeys.Count + 1)
        {
            throw new ArgumentException(
                "Two players have the same key, or one the connect key; each must have another.", nameof(PlayerKeys));
        }
    }
}
