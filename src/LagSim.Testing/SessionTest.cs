using System;
using System.Collections.Generic;
using System.Globalization;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;

namespace LagSim.Testing;

/// <summary>
/// A test of a scene under lag: a host and its clients play it over simulated links, and every one of them must end up with the same world.
/// </summary>
/// <remarks>
/// <para>Add players with their links, plan what each of them does and when, then call <see cref="Run"/>. The sessions are the real ones;
/// the network and the clocks are simulated. Nothing waits in real time: a minute of play takes as long as its computation. A difference of
/// one bit throws a <see cref="WorldsDifferException"/> that names player, body and instant.</para>
/// <para>Players are numbered: 0 is the host, the clients are 1, 2 and so on, in the order in which they are added. The initial ones have
/// that number as <see cref="Session.Peer"/> too, and with it whatever rights the scene gives to it. Every machine's clock reads another
/// time, up to an hour off, and runs up to 20 millionths fast or slow.</para>
/// <para>Deterministic: the same test with the same seed gives the same bits and the same figures on every machine, as long as the code it
/// is given is deterministic (actions, options, forces). One test can be run any number of times, each run starting over. For one thread;
/// different tests may run at once. Needs no test framework: failures throw.</para>
/// </remarks>
/// <example>
/// <code>
/// [Theory]
/// [MemberData(nameof(Links))] // public static TheoryData&lt;string&gt; Links => [.. LinkProfiles.Names];
/// public void Puck_HitByBoth_IsTheSameForAll(string link)
/// {
///     Scene scene = Table.Build();
///     SessionTestResult result = new SessionTest(scene)
///         .WithClients(2, link)
///         .At(1.0, player: 1, PlayerAction.Impulse(scene.BodyNamed("puck"), new Vector3D(2, 0, 0)))
///         .At(1.2, player: 2, PlayerAction.Impulse(scene.BodyNamed("puck"), new Vector3D(0, 0, -2)))
///         .Run(seconds: 5);
///     Assert.Equal(2, result.EventsAccepted);
/// }
/// </code>
/// </example>
public sealed class SessionTest
{
    /// <summary>The longest run, in seconds of the shared world: an hour.</summary>
    public const double MaxSeconds = 3600;

    private readonly List<PlannedClient> clients = [];
    private readonly List<PlannedAct> acts = [];
    private readonly Scene scene;
    private Func<int, SessionOptions>? options;
    private ulong seed = 1;

    /// <summary>Creates a test of a scene, with only a host so far.</summary>
    /// <param name="scene">The scene that all peers share. Its custom forces are handed to the clients with it.</param>
    public SessionTest(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        this.scene = scene;
    }

    /// <summary>Called with each player's number and session before the session's first step, to inject faults.</summary>
    internal Action<int, Session>? PrepareSession { get; set; }

    /// <summary>Adds clients that are there from the start, each over a link of its own to the host.</summary>
    /// <param name="count">
    /// The number of clients, 1 to <see cref="SessionOptions.MaxClients"/>; all clients together no more than that.
    /// </param>
    /// <param name="link">The profile of their links.</param>
    /// <exception cref="ArgumentOutOfRangeException">The host has no room for that number of clients.</exception>
    public SessionTest WithClients(int count, LinkProfile link)
    {
        ArgumentNullException.ThrowIfNull(link);
        int room = SessionOptions.MaxClients - clients.Count;
        if (count < 1 || count > room)
        {
            throw new ArgumentOutOfRangeException(
                nameof(count),
                count,
                $"A host has room for {SessionOptions.MaxClients} clients and {clients.Count} are there: 1 to {room} can be added.");
        }

        for (int n = 0; n < count; n++)
        {
            clients.Add(new PlannedClient(link, null));
        }

        return this;
    }

    /// <summary>Adds clients over links with a named profile, such as <c>4g</c>, <c>awful</c> or <c>delay-80ms</c>.</summary>
    /// <param name="count">As for the other overload.</param>
    /// <param name="link">One of <see cref="LinkProfiles.Names"/>, or <c>delay-Nms</c>; case matters.</param>
    /// <exception cref="ArgumentException">There is no such profile; the message lists those that exist.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The host has no room for that number of clients.</exception>
    public SessionTest WithClients(int count, string link) => WithClients(count, LinkProfiles.Get(link));

    /// <summary>Adds a client that asks to join while the others play. It is in some round trips later, and can act from then on.</summary>
    /// <param name="seconds">When it asks, in seconds since the start of the world; 0 to <see cref="MaxSeconds"/>.</param>
    /// <param name="link">The profile of its link.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time is out of range, or the host has no room for another client.</exception>
    public SessionTest WithLateClient(double seconds, LinkProfile link)
    {
        CheckTime(seconds);
        WithClients(1, link);
        clients[^1] = clients[^1] with { AsksAtSeconds = seconds };
        return this;
    }

    /// <summary>Adds such a client over a link with a named profile.</summary>
    /// <param name="seconds">As for the other overload.</param>
    /// <param name="link">One of <see cref="LinkProfiles.Names"/>, or <c>delay-Nms</c>; case matters.</param>
    /// <exception cref="ArgumentException">There is no such profile, or a value is out of range as for the other overload.</exception>
    public SessionTest WithLateClient(double seconds, string link) => WithLateClient(seconds, LinkProfiles.Get(link));

    /// <summary>Sets the seed of all links and clocks. Default 1.</summary>
    /// <param name="seed">Any number. Runs with other seeds lose other datagrams.</param>
    public SessionTest WithSeed(ulong seed)
    {
        this.seed = seed;
        return this;
    }

    /// <summary>Sets how the peers take part: the game's own session options. Default: all defaults.</summary>
    /// <param name="options">
    /// Called once per run for each player, with its number: 0 is the host. Returns <see cref="HostOptions"/> or
    /// <see cref="ClientOptions"/>; if a host gets a client's, or a client a host's, the shared settings apply. The test itself sets
    /// <see cref="HostOptions.ExpectedClients"/>, <see cref="SessionOptions.Cancellation"/>, and a <see cref="HostOptions.StartLead"/> in
    /// which every client receives the start; a client without <see cref="ClientOptions.Accelerations"/> or
    /// <see cref="ClientOptions.Rules"/> gets the scene's; and without contact notices, timelines are kept for the whole run
    /// (<see cref="SessionOptions.ExtraHistory"/>), so that a difference can be named to the event.
    /// </param>
    public SessionTest WithOptions(Func<int, SessionOptions> options)
    {
        ArgumentNullException.ThrowIfNull(options);
        this.options = options;
        return this;
    }

    /// <summary>Plans a player's action at a given time.</summary>
    /// <param name="seconds">
    /// The time, in seconds since the start of the world by true time; 0 to <see cref="MaxSeconds"/>. The event is stamped with the
    /// player's shared clock at that moment.
    /// </param>
    /// <param name="player">The player: 0 for the host, or a client that has been added.</param>
    /// <param name="action">The action.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time is out of range, or there is no such player yet.</exception>
    public SessionTest At(double seconds, int player, PlayerAction action) => At(seconds, player, who => who.Do(action));

    /// <summary>Plans code that looks at a player's world and acts, at a given time.</summary>
    /// <param name="seconds">As for the other overload.</param>
    /// <param name="player">As for the other overload.</param>
    /// <param name="act">
    /// Called on the thread of <see cref="Run"/>. For a repeatable run it must do the same each time: no clock, and random numbers only
    /// from a seed of its own.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">The time is out of range, or there is no such player yet.</exception>
    public SessionTest At(double seconds, int player, Action<TestPlayer> act)
    {
        ArgumentNullException.ThrowIfNull(act);
        CheckTime(seconds);
        CheckPlayer(player);
        acts.Add(new PlannedAct(seconds, null, player, act));
        return this;
    }

    /// <summary>
    /// Plans code that acts for a player again and again from the start on, as a bot does each frame. Moments at which the player is not in
    /// the session are skipped.
    /// </summary>
    /// <param name="seconds">The interval, in seconds; 0.001 to <see cref="MaxSeconds"/>. A frame is 1 / 60.0.</param>
    /// <param name="player">The player: 0 for the host, or a client that has been added.</param>
    /// <param name="act">As for <see cref="At(double, int, Action{TestPlayer})"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The interval is out of range, or there is no such player yet.</exception>
    public SessionTest Every(double seconds, int player, Action<TestPlayer> act)
    {
        ArgumentNullException.ThrowIfNull(act);
        if (!(seconds is >= 0.001 and <= MaxSeconds))
        {
            throw new ArgumentOutOfRangeException(nameof(seconds), seconds, $"A player acts every 0.001 to {MaxSeconds} s.");
        }

        CheckPlayer(player);
        acts.Add(new PlannedAct(0, seconds, player, act));
        return this;
    }

    /// <summary>
    /// Plays the test, and throws unless every player ends up with the world that all accepted events produce, bit for bit.
    /// </summary>
    /// <param name="seconds">
    /// How long to play, in seconds since the start of the world, above 0 and up to <see cref="MaxSeconds"/>. The run continues for a
    /// little until all players have received everything.
    /// </param>
    /// <param name="cancellation">
    /// Ends a run early, by an <see cref="OperationCanceledException"/>; default none. Pass that of the test framework.
    /// </param>
    /// <returns>The result: how many events were late, what healing did, the network traffic, and the world to read.</returns>
    /// <exception cref="WorldsDifferException">
    /// A state that a player committed, or what its world keeps at the end, differs. The message names the first difference.
    /// </exception>
    /// <exception cref="SessionTestException">The session did not finish, or a player performed an action that is not allowed.</exception>
    /// <exception cref="ArgumentOutOfRangeException">
    /// <paramref name="seconds"/> is out of range, or something is planned for later.
    /// </exception>
    /// <exception cref="ArgumentException">The session options are not valid; see <see cref="SessionOptions"/>.</exception>
    public SessionTestResult Run(double seconds, CancellationToken cancellation = default)
    {
        SessionTestResult result = RunUnchecked(seconds, cancellation);
        result.ThrowIfWorldsDiffer();
        return result;
    }

    /// <summary>
    /// Plays the test as <see cref="Run"/> does, but leaves a difference to the caller: see <see cref="SessionTestResult.WorldsAgree"/>.
    /// </summary>
    /// <remarks>For tests of a strategy that promises no agreement, and for negative controls.</remarks>
    /// <param name="seconds">As for <see cref="Run"/>.</param>
    /// <param name="cancellation">As for <see cref="Run"/>.</param>
    /// <exception cref="SessionTestException">The session did not finish, or a player performed an action that is not allowed.</exception>
    /// <exception cref="ArgumentOutOfRangeException">
    /// <paramref name="seconds"/> is out of range, or something is planned for later.
    /// </exception>
    /// <exception cref="ArgumentException">The session options are not valid; see <see cref="SessionOptions"/>.</exception>
    public SessionTestResult RunUnchecked(double seconds, CancellationToken cancellation = default)
    {
        if (!(seconds is > 0 and <= MaxSeconds))
        {
            throw new ArgumentOutOfRangeException(nameof(seconds), seconds, $"A run lasts above 0 and up to {MaxSeconds} s.");
        }

        foreach (PlannedAct act in acts)
        {
            if (act.AtSeconds > seconds)
            {
                throw TooShort(seconds, $"Player {act.Player} acts at {Text(act.AtSeconds)} s");
            }
        }

        for (int n = 0; n < clients.Count; n++)
        {
            if (clients[n].AsksAtSeconds is double asks && asks > seconds)
            {
                throw TooShort(seconds, $"Player {n + 1} asks to join at {Text(asks)} s");
            }
        }

        // A source of its own, since the token of a whole program would keep these peers alive.
        using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
        return new SessionRun(scene, clients, acts, seed, options ?? (_ => new HostOptions()), PrepareSession, stop.Token).Play(seconds);
    }

    private static ArgumentOutOfRangeException TooShort(double seconds, string what) =>
        new(nameof(seconds), seconds, $"{what}; the run must last that long at least.");

    private static void CheckTime(double seconds)
    {
        if (!(seconds is >= 0 and <= MaxSeconds))
        {
            throw new ArgumentOutOfRangeException(nameof(seconds), seconds, $"Things happen 0 to {MaxSeconds} s after the start.");
        }
    }

    private void CheckPlayer(int player)
    {
        if (player < 0 || player > clients.Count)
        {
            string there = clients.Count == 0 ? "there is only player 0, the host" : $"there are players 0, the host, to {clients.Count}";
            throw new ArgumentOutOfRangeException(nameof(player), player, $"Add clients before what they do: {there}.");
        }
    }

    private static string Text(double seconds) => seconds.ToString("0.######", CultureInfo.InvariantCulture);
}
