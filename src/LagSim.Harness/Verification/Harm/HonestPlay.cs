using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Verification.Harm;

/// <summary>Measures the cost of honest players in every built-in scene: how far they stay within their budgets.</summary>
/// <remarks>
/// In virtual time by a seed. Four players, 100 ms from the host, each with four actions a second on average, as many as in the busiest
/// sessions of <c>lagsim stalls</c>: velocities, impulses and teleports of the scene's bodies, up to six balls of its own, and hands that
/// hold a body for a second with keyframes every 50 ms.
/// </remarks>
public static class HonestPlay
{
    private const int Players = 4;
    private const double DelayMilliseconds = 100;
    private const double ActionsASecond = 4;
    private const int MaxSpawnedBodies = 6;
    private const double KeyframeSeconds = 0.05;

    private const string Heap = "heap";
    private const int HeapBalls = 32;

    /// <summary>
    /// The scenes: all built-in ones, two more crowds, and a heap of 32 balls poured like those of <c>lagsim accuracy heap</c>.
    /// </summary>
    public static IReadOnlyList<string> Scenes { get; } = [.. BuiltInScenes.Names, "crowd-1000", "crowd-5000", Heap];

    /// <summary>Plays one scene.</summary>
    /// <param name="scene">The name of the scene.</param>
    /// <param name="seed">The seed.</param>
    /// <param name="seconds">The duration, in seconds.</param>
    /// <param name="budget">The budget of each player.</param>
    /// <param name="cancellation">Ends it early.</param>
    public static HonestCost Play(string scene, ulong seed, double seconds, PlayerBudget budget, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(budget);
        Scene built = SceneOf(scene);

        SeededRandom random = new SeededRandom(seed).Fork(0x40E5);
        VirtualClock clock = new(SimTime.FromSeconds(10));
        VirtualNetwork network = new(clock, seed, LinkProfiles.PureDelay(DelayMilliseconds));
        VirtualSteps steps = new(network);
        for (int peer = 0; peer <= Players; peer++)
        {
            IDatagramPort port = network.CreatePort(peer);
            HostOptions options = new() { ExpectedClients = Players, PlayerBudget = budget, Cancellation = cancellation };
            steps.Add(
                peer == 0
                    ? new HostSession(built, port, clock, options, seed)
                    : new ClientSession(
                        null, port, clock, ClientOptions.From(options) with { Rules = BuiltInRules.All }, PeerAddress.Virtual(0), (seed * 16) + (ulong)peer),
                port);
        }

        HostSession host = (HostSession)steps.Sessions[0];
        int expelled = 0;
        host.PlayerExpelled += _ => expelled++;
        while (steps.Sessions.Any(s => s.State != SessionState.Running))
        {
            cancellation.ThrowIfCancellationRequested();
            steps.RunFor(SimDuration.FromSeconds(0.1));
        }

        Player[] players = [.. Enumerable.Range(1, Players).Select(n => new Player(steps, n, built, random.Fork((ulong)n)))];
        SimTime from = clock.Now;
        for (double now = 0; now < seconds; now += 0.01)
        {
            cancellation.ThrowIfCancellationRequested();
            foreach (Player player in players)
            {
                player.Act(now);
            }

            while (clock.Now < from + SimDuration.FromSeconds(now + 0.01))
            {
                steps.Advance(from + SimDuration.FromSeconds(now + 0.01));
            }
        }

        PlayerCost[] costs = [.. host.Costs.Where(c => c.Player > 0)];
        double most = costs.Select(c => c.PeakWork).DefaultIfEmpty(0).Max();
        return new HonestCost(
            scene, Players, costs.Select(c => c.Work).DefaultIfEmpty(0).Max() / seconds, most, most / budget.WorkAtOnce, host.Counters.EventsAccepted + host.Counters.EventsRefused, expelled);
    }

    private static Scene SceneOf(string name) => name == Heap ? new HeapWork(HeapBalls).Scene
        : BuiltInScenes.TryGet(name, out Scene? built) ? built
        : throw new ArgumentException($"There is no scene '{name}'; there are {BuiltInScenes.KnownNames}, {Heap}.", nameof(name));

    private sealed class Player(VirtualSteps steps, int peer, Scene scene, SeededRandom random)
    {
        private readonly Queue<BodyId> mine = new();
        private double next = random.NextDouble();
        private BodyId? held;
        private double nextKeyframe;
        private double lastKeyframe;
        private Vector3D hand;

        internal void Act(double now)
        {
            if (held is BodyId body && now >= nextKeyframe)
            {
                nextKeyframe += KeyframeSeconds;
                hand += new Vector3D(random.NextDouble(-1, 1), random.NextDouble(0, 1), random.NextDouble(-1, 1)) * KeyframeSeconds;
                Try(now < lastKeyframe ? PlayerAction.HoldKeyframe(body, hand, Vector3D.Zero) : PlayerAction.Release(body, Velocity(3)));
                held = now < lastKeyframe ? held : null;
            }

            if (now < next || steps.Sessions[peer].World is null)
            {
                return;
            }

            next += random.NextDouble(0.5, 1.5) / ActionsASecond;
            BodyId which = BodyId.OfScene(random.NextInt(scene.Bodies.Count));
            Simulation world = steps.Sessions[peer].World!.Simulation;
            Vector3D there = world.TryRead(which, world.SimulatedTo, out BodyState state) ? state.Position : Vector3D.Zero;
            switch (random.NextInt(10))
            {
                case 0 or 1:
                    while (mine.Count >= MaxSpawnedBodies)
                    {
                        Try(PlayerAction.Remove(mine.Dequeue()));
                    }

                    if (Try(PlayerAction.Spawn(scene.Bodies[which.Index].Spec, there + new Vector3D(random.NextDouble(-1, 1), 2, random.NextDouble(-1, 1)), Velocity(3))) is ExternalEvent spawn)
                    {
                        mine.Enqueue(spawn.Body);
                    }

                    break;
                case 2:
                    Try(PlayerAction.Teleport(which, there + new Vector3D(0, 1, 0), Velocity(3)));
                    break;
                case 3 when held is null:
                    held = Try(PlayerAction.Grab(which, default)) is null ? null : which;
                    (hand, nextKeyframe, lastKeyframe) = (there, now + KeyframeSeconds, now + 1);
                    break;
                case 4 or 5 or 6:
                    Try(PlayerAction.Impulse(which, Velocity(6) * scene.Bodies[which.Index].Spec.Mass));
                    break;
                default:
                    Try(PlayerAction.SetVelocity(which, Velocity(6)));
                    break;
            }
        }

        private Vector3D Velocity(double most) => new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-0.3, 1), random.NextDouble(-1, 1)) * most;

        private ExternalEvent? Try(PlayerAction action)
        {
            if (steps.Sessions[peer].State != SessionState.Running)
            {
                return null;
            }

            try
            {
                ExternalEvent external = steps.Sessions[peer].Do(action);
                steps.Wake(peer);
                return external;
            }
            catch (Exception why) when (why is SceneException or InvalidOperationException)
            {
                return null; // the scene does not have it, or not there
            }
        }
    }
}
