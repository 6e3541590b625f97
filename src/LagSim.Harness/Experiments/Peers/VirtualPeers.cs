using System;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Net.Carriers;
using LagSim.Net.Sessions;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Testing.Running;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>A group of peers in lock-step virtual time: one thread, no waiting, and the same seed gives the same run to the bit.</summary>
public sealed class VirtualPeers : PeerGroup
{
    /// <summary>The clocks of two machines: up to an hour apart, and up to 20 millionths fast or slow.</summary>
    private const double ClockSpreadSeconds = 3600;
    private const double ClockDriftPartsPerMillion = 20;

    private static readonly SimDuration ConnectDeadline = SimDuration.FromSeconds(60);

    /// <summary>
    /// The most that a sample may be late. Different clock speeds make it some nanoseconds, and some microseconds while a clock is
    /// adjusted.
    /// </summary>
    private static readonly SimDuration Timeout = SimDuration.FromMilliseconds(0.5);

    private readonly PeerGroupOptions options;
    private readonly VirtualClock clock = new(SimTime.FromSeconds(2 * ClockSpreadSeconds));
    private readonly VirtualNetwork network;
    private readonly VirtualSteps steps;
    private readonly Session[] sessions;
    private readonly CancellationTokenSource stop; // linked, so that a token of the whole program does not keep these sessions alive

    /// <summary>Creates the peers without connecting them.</summary>
    public VirtualPeers(Scene scene, PeerGroupOptions options)
        : base(scene, options)
    {
        this.options = options;
        network = new VirtualNetwork(clock, options.Seed, options.Link);
        SeededRandom random = new SeededRandom(options.Seed).Fork(0xC10C);
        sessions = new Session[PeerCount];
        stop = CancellationTokenSource.CreateLinkedTokenSource(options.Cancellation);
        steps = new VirtualSteps(network);
        for (int peer = 0; peer < PeerCount; peer++)
        {
            IDatagramPort port = network.CreatePort(peer);
            double drift = ((2 * random.NextDouble()) - 1) * ClockDriftPartsPerMillion;
            SimDuration apart = SimDuration.FromSeconds(((2 * random.NextDouble()) - 1) * ClockSpreadSeconds);
            SkewedClock own = new(clock, drift, peer == 0 ? apart : apart + options.Link.ReceiverClockOffset);
            HostOptions session = options.ToHostOptions() with { Cancellation = stop.Token };
            sessions[peer] = peer == 0
                ? new HostSession(scene, port, own, session, options.Seed)
                : new ClientSession(scene, port, own, ClientOptions.From(session), PeerAddress.Virtual(0), options.Seed + (ulong)peer);
            steps.Add(sessions[peer], port);
        }
    }

    /// <summary>The network, for tests that drop datagrams or read losses.</summary>
    public VirtualNetwork Network => network;

    /// <summary>The steps, for tests that observe each.</summary>
    internal VirtualSteps Steps => steps;

    /// <inheritdoc/>
    public override Session Session(int peer) => sessions[peer];

    /// <inheritdoc/>
    public override PortTraffic Traffic(int peer) => network.Traffic(peer);

    /// <inheritdoc/>
    public override void Connect()
    {
        SimTime deadline = clock.Now + ConnectDeadline;
        while (sessions.Any(s => s.World is null))
        {
            steps.Advance(deadline);
            Session? ended = sessions.FirstOrDefault(s => s.State == SessionState.Ended);
            if (ended is not null || clock.Now >= deadline)
            {
                throw new PeerGroupException(ended?.EndReason ?? $"Not all peers were connected after {ConnectDeadline.ToSeconds()} s of virtual time.");
            }
        }

        Start = sessions[0].World!.Simulation.Start;
        PrepareSamples(options.Length, PeerGroupOptions.SampleInterval);
    }

    /// <inheritdoc/>
    public override void RunUntil(SimDuration sinceStart, Action<SimDuration>? progress) => Run(Start + sinceStart, [sessions[0]], progress);

    /// <inheritdoc/>
    public override void RunQuietlyUntil(SimDuration sinceStart, Action<SimDuration>? progress) => Run(Start + sinceStart, sessions, progress);

    /// <inheritdoc/>
    public override ExternalEvent Do(int peer, PlayerAction action)
    {
        ExternalEvent external = sessions[peer].Do(action);
        steps.Wake(peer);
        return external;
    }

    /// <inheritdoc/>
    public override void Finish() => CollectSettled();

    /// <inheritdoc/>
    public override void Dispose() => stop.Dispose();

    private void Run(SimTime end, Session[] clocks, Action<SimDuration>? progress)
    {
        for (SimDuration left; (left = LeftUntil(end, clocks)) > SimDuration.Zero;)
        {
            SimTime next = clock.Now + left;
            for (int peer = 0; peer < PeerCount; peer++)
            {
                if (!Seen[peer].IsComplete)
                {
                    next = SimTime.Min(next, clock.Now + AtLeastATick(Seen[peer].NextTime - sessions[peer].SharedTime.Now));
                }
            }

            steps.Advance(next);
            Sample();
            for (int peer = 0; peer < PeerCount; peer++)
            {
                ThrowIfEnded(peer, sessions[peer].State, sessions[peer]);
            }

            progress?.Invoke(sessions[0].SharedTime.Now - Start);
        }
    }

    private void Sample()
    {
        for (int peer = 0; peer < PeerCount; peer++)
        {
            Session session = sessions[peer];
            bool isHostsInstant = peer == 0 && !Seen[0].IsComplete && Seen[0].NextTime <= session.SharedTime.Now;
            int n = Seen[0].Next;
            Seen[peer].Take(session.World!.RenderSnapshots.Latest(), session.SharedTime.Now, Timeout);
            if (isHostsInstant)
            {
                SampleTrueTime(n);
            }
        }
    }

    private void SampleTrueTime(int n)
    {
        SimTime host = sessions[0].SharedTime.Now;
        for (int peer = 0; peer < PeerCount; peer++)
        {
            SimTime own = sessions[peer].SharedTime.Now;
            SeenTrueTime[peer].TakeAt(n, sessions[peer].World!.RenderSnapshots.Latest(), own);
            ClockErrorMilliseconds[n] = Math.Max(ClockErrorMilliseconds[n], Math.Abs((own - host).ToMilliseconds()));
        }
    }

    private static SimDuration AtLeastATick(SimDuration span) => span > SimDuration.Zero ? span : SimDuration.OneTick;
}
