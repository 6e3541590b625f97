using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Sessions.Hosts;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// How a host takes part: whom it lets in, what players may cost, and what <see cref="SessionOptions"/> has for every peer.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread. Validated when the session is made, with a sentence that names the value and what is allowed.
/// </remarks>
/// <example>
/// A host for two players who know a secret, and may be 400 ms late:
/// <code>
/// HostOptions options = new()
/// {
///     ConnectKey = "correct horse battery staple",
///     ExpectedClients = 2,
///     Window = new LatencyCompensationWindow(history: SimDuration.FromMilliseconds(400)),
/// };
/// using PeerThread host = PeerThread.Host(scene, udpPort: 5000, options, setUp: session =&gt;
///     session.ClientCame += link =&gt; Console.WriteLine($"player {link.Peer} is in"));
/// </code>
/// </example>
public sealed record HostOptions : SessionOptions
{
    private static readonly IReadOnlyDictionary<byte, string> NoKeys = new Dictionary<byte, string>();

    private readonly int? perAddress;
    private readonly IReadOnlyDictionary<byte, string>? playerKeys = NoKeys;

    /// <summary>A host that begins at once, whoever joins later.</summary>
    public HostOptions()
    {
    }

    private HostOptions(SessionOptions common)
        : base(common)
    {
    }

    /// <summary>
    /// Keys of players by number, 1 to <see cref="SessionOptions.MaxClients"/>; default none. Who gives such a key as its
    /// <see cref="SessionOptions.ConnectKey"/> has that number, whenever it comes, and takes it over from whoever still holds it; nobody
    /// else gets it.
    /// </summary>
    /// <remarks>
    /// Without, numbers go by order of arrival and are given again, and with them what a scene grants to a number. The dictionary is
    /// copied: what is put into it later changes nothing.
    /// </remarks>
    public IReadOnlyDictionary<byte, string> PlayerKeys
    {
        get => playerKeys!;
        init => playerKeys = value is null ? null : new Dictionary<byte, string>(value);
    }

    /// <summary>
    /// How many clients may be in from one address, whatever their ports, 1 to <see cref="SessionOptions.MaxClients"/>; default half of the
    /// places, or <see cref="ExpectedClients"/> if that is more. So nobody takes all places from one machine. Players behind one NAT share
    /// an address.
    /// </summary>
    public int MaxClientsPerAddress
    {
        get => perAddress ?? Math.Max(MaxClients / 2, ExpectedClients);
        init => perAddress = value;
    }

    /// <summary>
    /// How many events a second are taken from each client, 1 to 100,000; default 500. What is more is taken later. Thousands need a larger
    /// <see cref="PlayerBudget"/>, or none.
    /// </summary>
    public int MaxEventsPerSecond { get; init; } = 500;

    /// <summary>
    /// What a player's acts may cost, in work to simulate what comes of them; default <see cref="PlayerBudget.Default"/>, and null for no
    /// limit. Who has used up half of it has its acts refused (<see cref="Wire.Verdict.NoRight"/>) but for removals and releases; who has
    /// used it up is sent away as by <see cref="HostSession.Kick"/>, nobody is let in from its machine for a minute, what it spawned is
    /// removed as of before the work began, and what else it moved and much of the work was for is stopped. See
    /// <see cref="HostSession.PlayerExpelled"/>. While the world is 150 ms late, half of it is all there is.
    /// </summary>
    /// <remarks>
    /// An event on a body in free flight that comes late counts 12 units and more. The default of <see cref="MaxEventsPerSecond"/> is far
    /// from the budget; who permits thousands a second raises it in proportion.
    /// </remarks>
    public PlayerBudget? PlayerBudget { get; init; } = PlayerBudget.Default;

    /// <summary>
    /// How many clients the start waits for, 0 to 8; default 0. Before the start there is no world, and nothing can be done.
    /// </summary>
    public int ExpectedClients { get; init; }

    /// <summary>How long after all expected clients are ready the scene starts, 0 to 60 s; default 500 ms.</summary>
    public SimDuration StartLead { get; init; } = SimDuration.FromMilliseconds(500);

    /// <summary>What those who are coming in can have.</summary>
    internal DoorLimits Door { get; init; } = new();

    /// <summary>
    /// The same options, if they are a host's; else those of a host that has the settings which both sides have, and defaults.
    /// </summary>
    /// <exception cref="ArgumentNullException">There are none.</exception>
    public static HostOptions From(SessionOptions options) =>
        options as HostOptions ?? new HostOptions(options ?? throw new ArgumentNullException(nameof(options)));

    internal override void Check()
    {
        base.Check();
        Range(StartLead, 0, 60, nameof(StartLead));
        CheckPlayerKeys();
        if (MaxEventsPerSecond is < 1 or > 100_000)
        {
            throw new ArgumentOutOfRangeException(
                nameof(MaxEventsPerSecond), MaxEventsPerSecond, "A host takes 1 to 100,000 events a second from a client.");
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

        if (PlayerKeys.Values.Append(ConnectKey).Distinct().Count() != PlayerKeys.Count + 1)
        {
            throw new ArgumentException(
                "Two players have the same key, or one the connect key; each must have another.", nameof(PlayerKeys));
        }
    }
}
