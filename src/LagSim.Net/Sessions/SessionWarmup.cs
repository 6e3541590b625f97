using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Net.Sessions;

/// <summary>
/// Compiles the code that events need before the first one arrives: a private host and client play every kind of event, in memory and in
/// virtual time.
/// </summary>
/// <remarks>
/// A JIT runtime compiles a method when it is first called. An event passes through several hundred methods on its way to another world, so
/// the first one took some fifty times as long as the next. The program's own session is not touched: the warm-up has worlds, clocks, ports
/// and numbers of its own.
/// </remarks>
internal sealed class SessionWarmup
{
    /// <summary>
    /// In the first round events arrive on time; in the second they are late and are healed. Further rounds compile nothing new.
    /// </summary>
    private const int Rounds = 2;

    /// <summary>The number of frames by which a late event is delayed.</summary>
    private const int FramesLate = 5;

    /// <summary>
    /// The number of frames until the host has committed a state to copy to a joining client, and until the two peers run.
    /// </summary>
    private const int FramesToStart = 30;

    /// <summary>The number of bodies that the host lets one player spawn.</summary>
    private const int MaxSpawnedBodies = 2;

    /// <summary>How often each peer steps within a frame: for an event, its acknowledgement, and the reply to that.</summary>
    private const int TurnsAFrame = 3;

    private static readonly SimDuration Frame = SimDuration.FromMilliseconds(15);
    private static readonly TimeSpan LookInterval = TimeSpan.FromMilliseconds(20);
    private static readonly Dictionary<LateEventStrategy, Task> Begun = new(); // also the lock

    private readonly ManualClock clock = new();
    private readonly WarmupPort hostPort;
    private readonly WarmupPort clientPort;
    private readonly PeerThread host;
    private readonly PeerThread client;

    // These threads are never started: the caller steps the sessions.
    private SessionWarmup(LateEventStrategy strategy, Scene scene)
    {
        (hostPort, clientPort) = WarmupPort.Pair();
        host = new PeerThread(new HostSession(scene, hostPort, clock, Options(strategy, MaxSpawnedBodies), 1), hostPort, "warm-up host");
        for (int n = 0; n < FramesToStart; n++)
        {
            clock.Now += Frame;
            host.Step();
        }

        ClientOptions options = ClientOptions.From(Options(strategy, 8)) with
        {
            Contacts = new ContactNotices(),
            Rules = new[] { scene.Rules! },
        };
        client = new PeerThread(new ClientSession(null, clientPort, clock, options, hostPort.LocalAddress, 2), clientPort, "warm-up client");
        host.Session.Logged += entry => Note(entry, HeardByHost, from: 1);
        client.Session.Logged += entry => Note(entry, HeardByClient, from: 0);
    }

    /// <summary>Every kind of event.</summary>
    internal static IReadOnlyList<EventKind> EveryKind { get; } = new[]
    {
        EventKind.Spawn, EventKind.Impulse, EventKind.SetVelocity, EventKind.Teleport, EventKind.Grab, EventKind.HoldKeyframe, EventKind.Release, EventKind.Remove,
        EventKind.SetFilter, EventKind.Command,
    };

    /// <summary>The kinds of client events that the host accepted.</summary>
    internal SortedSet<EventKind> HeardByHost { get; } = new();

    /// <summary>The kinds of host events that the client accepted.</summary>
    internal SortedSet<EventKind> HeardByClient { get; } = new();

    /// <summary>The host's counters.</summary>
    internal SessionCounters HostCounters => host.Session.Counters;

    /// <summary>The client's counters.</summary>
    internal SessionCounters ClientCounters => client.Session.Counters;

    /// <summary>
    /// Warms up for a session that is about to take its first step, on a thread beside it; once per process and strategy. A host does not
    /// wait for that: others ask it already. A client does: events of one that is in before it is warm could come too late. Does nothing
    /// where no code is compiled at run time.
    /// </summary>
    /// <param name="session">The session.</param>
    /// <param name="isOver">Whether the client is to wait no longer.</param>
    internal static void Before(Session session, Func<bool> isOver)
    {
        if (RuntimeFeature.IsDynamicCodeCompiled)
        {
            Before(session, isOver, Begin);
        }
    }

    /// <summary>The same, by a given warm-up.</summary>
    internal static void Before(Session session, Func<bool> isOver, Func<LateEventStrategy, Task> begin)
    {
        if (session.WarmsUpFor is LateEventStrategy strategy)
        {
            Task warm = begin(strategy);
            while (session is ClientSession && !isOver() && !warm.Wait(LookInterval))
            {
                // until it is warm, or need not be
            }
        }
    }

    private static Task Begin(LateEventStrategy strategy)
    {
        lock (Begun)
        {
            if (!Begun.TryGetValue(strategy, out Task? warm))
            {
                warm = Task.Factory.StartNew(
                    () => Run(strategy), CancellationToken.None, TaskCreationOptions.LongRunning, TaskScheduler.Default);
                Begun.Add(strategy, warm);
            }

            return warm;
        }
    }

    private static void Run(LateEventStrategy strategy)
    {
        try
        {
            Run(strategy, EveryKind, few: true);
            Run(strategy, EveryKind, few: false);
        }
        catch (Exception failure) when (failure is not OutOfMemoryException)
        {
            // The sessions just lose some milliseconds at their first events.
        }
    }

    /// <summary>Warms up, even if it was done before.</summary>
    /// <param name="strategy">How late events are handled; <see cref="SessionOptions.Strategy"/>.</param>
    /// <param name="kinds">The kinds of events to play.</param>
    /// <param name="few">Whether among a few bodies of all kinds, or among many; <see cref="WarmupScene.Of"/>.</param>
    internal static SessionWarmup Run(LateEventStrategy strategy, IReadOnlyList<EventKind> kinds, bool few)
    {
        SessionWarmup warmup = new(strategy, WarmupScene.Of(few));
        warmup.Play(kinds);
        return warmup;
    }

    private static HostOptions Options(LateEventStrategy strategy, int maxSpawned) => new()
    {
        Strategy = strategy,
        Warmup = false,
        StartLead = SimDuration.Zero,
        CommitInterval = SimDuration.FromMilliseconds(100),
        Window = new LatencyCompensationWindow(SimDuration.FromMilliseconds(200)),
        MaxSpawned = maxSpawned,
    };

    private static PlayerAction Action(EventKind kind, int body, BodyId spawned)
    {
        BodyId own = BodyId.OfScene(body);
        Vector3D home = new(body == WarmupScene.HostsBody ? -3 : 3, 1, 0);
        return kind switch
        {
            EventKind.Spawn => PlayerAction.Spawn(new BodySpec(0.5, 1, 0.5), home + new Vector3D(0, 2, -3), new Vector3D(0, 1, 0), new Vector3D(1, 0, 0)),
            EventKind.Impulse => PlayerAction.Impulse(own, new Vector3D(3, 1, 0)), // into the ball beside it
            EventKind.SetVelocity => PlayerAction.SetVelocity(own, new Vector3D(2, 2, 0)),
            EventKind.Teleport => PlayerAction.Teleport(own, home, new Vector3D(0, 1, 0)),
            EventKind.Grab => PlayerAction.Grab(own, new Vector3D(0, 0.1, 0)),
            EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(own, home + new Vector3D(0, 0.2, 0), new Vector3D(0, 1, 0)),
            EventKind.Release => PlayerAction.Release(own, new Vector3D(1, 1, 0)),
            EventKind.Command => PlayerAction.Command(new GameCommand(1)),
            EventKind.SetFilter => PlayerAction.SetFilter(own, new CollisionFilter(2)),
            _ => PlayerAction.Remove(spawned),
        };
    }

    private void Play(IReadOnlyList<EventKind> kinds)
    {
        Run(FramesToStart);
        for (int round = 0; round < Rounds; round++)
        {
            Play(host, clientPort, WarmupScene.HostsBody, kinds, isLate: round > 0);
            Play(client, hostPort, WarmupScene.ClientsBody, kinds, isLate: round > 0);
        }

        Run(FramesToStart); // until the removed bodies are forgotten
        client.Session.Leave();
        Run(1);
        host.Session.Leave();
    }

    private void Play(PeerThread player, WarmupPort others, int body, IReadOnlyList<EventKind> kinds, bool isLate)
    {
        BodyId spawned = default;
        foreach (EventKind kind in kinds)
        {
            others.IsHeld = isLate;
            PlayerAction action = Action(kind, body, spawned);
            ExternalEvent done = Do(player, action);
            spawned = kind == EventKind.Spawn ? done.Body : spawned;
            for (int n = 0; n < MaxSpawnedBodies && kind == EventKind.Spawn && player == client; n++)
            {
                Do(player, action); // the last one exceeds the host's limit and is retracted
            }

            Run(isLate ? FramesLate : 1);
            others.IsHeld = false;
            Run(1);
        }
    }

    private static ExternalEvent Do(PeerThread player, in PlayerAction action)
    {
        ValueTask<ExternalEvent> answer = player.Do(action);
        player.Step();
        return answer.GetAwaiter().GetResult(); // already completed
    }

    private static void Note(in LogEntry entry, SortedSet<EventKind> heard, byte from)
    {
        if (entry.Event.Peer == from && entry.IsAccepted)
        {
            heard.Add(entry.Event.Kind);
        }
    }

    private void Run(int frames)
    {
        for (int n = 0; n < frames; n++)
        {
            clock.Now += Frame;
            for (int turn = 0; turn < TurnsAFrame; turn++)
            {
                host.Step();
                client.Step();
            }
        }
    }

    private sealed class ManualClock : IClock
    {
        public SimTime Now { get; set; } = SimTime.FromSeconds(1);
    }
}
