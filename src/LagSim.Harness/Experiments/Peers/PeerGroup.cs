using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>A host and its clients in one process, each with its own clock, sampled while they share a world.</summary>
/// <remarks>
/// In real time (<see cref="RealPeers"/>) and in virtual time (<see cref="VirtualPeers"/>) the same sessions and strategies run.
/// </remarks>
public abstract class PeerGroup : IDisposable
{
    /// <summary>How long before its end a run is not sampled, to measure the cost of a world at rest.</summary>
    public static readonly SimDuration QuietTime = SimDuration.FromSeconds(1);

    private protected PeerGroup(Scene scene, PeerGroupOptions options)
    {
        Scene = scene;
        PeerCount = options.Peers;
        Bodies = [.. Enumerable.Range(0, scene.Bodies.Count).Select(BodyId.OfScene), .. options.Spawned];
        DisplayDelay = LateEventStrategies.Create(options.Strategy, options.DisplayDelay).DisplayDelay;
    }

    /// <summary>The options of the group.</summary>
    public Scene Scene { get; }

    /// <summary>The number of peers, the host included.</summary>
    public int PeerCount { get; }

    /// <summary>The bodies that are compared: the scene's own, then those to be spawned.</summary>
    public BodyId[] Bodies { get; }

    /// <summary>How far behind their shared clocks the peers show the world.</summary>
    public SimDuration DisplayDelay { get; }

    /// <summary>The start of the scene, in shared time; known once connected.</summary>
    public SimTime Start { get; private protected set; }

    /// <summary>The samples of each peer, the host first.</summary>
    public IReadOnlyList<PeerSamples> Seen { get; private protected set; } = [];

    /// <summary>The samples of each peer at the same true instants.</summary>
    public IReadOnlyList<PeerSamples> SeenTrueTime { get; private protected set; } = [];

    /// <summary>The settled timelines of each peer, sampled at the end.</summary>
    public IReadOnlyList<PeerSamples> Settled { get; private protected set; } = [];

    /// <summary>
    /// The largest distance of a client's shared clock from the host's at each true instant that was sampled, in milliseconds.
    /// </summary>
    public double[] ClockErrorMilliseconds { get; private protected set; } = [];

    /// <summary>The processor use while everything rested and nothing was sampled, in cores; null where it was not measured.</summary>
    public double? CpuCoresAtRest { get; private protected set; }

    /// <summary>The instants at which peers are compared.</summary>
    public SampleGrid Grid { get; private protected set; }

    /// <summary>Returns a session, to be read once the run has ended.</summary>
    public abstract Session Session(int peer);

    /// <summary>Returns the traffic of a peer so far.</summary>
    public abstract PortTraffic Traffic(int peer);

    /// <summary>Connects all peers and waits until each knows the start.</summary>
    /// <exception cref="PeerGroupException">Not all peers connected in time.</exception>
    public abstract void Connect();

    /// <summary>Runs and samples until the host's shared clock reads a time after the start.</summary>
    public abstract void RunUntil(SimDuration sinceStart, Action<SimDuration>? progress);

    /// <summary>
    /// As <see cref="RunUntil"/>, until every peer's shared clock reads the time. Nothing is sampled at the end, while the cost at rest is
    /// measured.
    /// </summary>
    public abstract void RunQuietlyUntil(SimDuration sinceStart, Action<SimDuration>? progress);

    /// <summary>Performs an action as a peer, now.</summary>
    public abstract ExternalEvent Do(int peer, PlayerAction action);

    /// <summary>Ends all sessions and samples the settled timelines.</summary>
    public abstract void Finish();

    /// <inheritdoc/>
    public abstract void Dispose();

    /// <summary>Throws if a session ended during the run, since the measurements are meaningless then.</summary>
    private protected static void ThrowIfEnded(int peer, SessionState state, Session session)
    {
        if (state == SessionState.Ended)
        {
            throw new PeerGroupException($"Peer {peer} dropped out: {session.EndReason}");
        }
    }

    /// <summary>Returns the time until the slowest of some shared clocks reads <paramref name="end"/>; zero or less once it does.</summary>
    private protected static SimDuration LeftUntil(SimTime end, IEnumerable<Session> sessions) =>
        sessions.Select(session => end - session.SharedTime.Now).Max();

    private protected void PrepareSamples(SimDuration length, SimDuration interval)
    {
        Grid = new SampleGrid(Start, interval, (int)(length.Ticks / interval.Ticks));
        Seen = NewSamples(DisplayDelay);
        SeenTrueTime = NewSamples(DisplayDelay);
        Settled = NewSamples(SimDuration.Zero);
        ClockErrorMilliseconds = new double[Grid.Count];
    }

    private protected void CollectSettled()
    {
        for (int peer = 0; peer < PeerCount; peer++)
        {
            if (Session(peer).World is { } world)
            {
                Settled[peer].TakeSettled(world.Simulation);
            }
        }
    }

    private PeerSamples[] NewSamples(SimDuration delay) => Enumerable.Range(0, PeerCount).Select(_ => new PeerSamples(Grid, Bodies, delay)).ToArray();
}
