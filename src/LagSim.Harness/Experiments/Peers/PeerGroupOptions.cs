using System.Collections.Generic;
using System.Threading;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The options of a group of peers: how they are connected and sampled.</summary>
/// <param name="Peers">The number of peers, the host included; 2 to 9.</param>
/// <param name="Link">The link of each client to the host.</param>
/// <param name="Strategy">The strategy of all peers for late events.</param>
/// <param name="Seed">The seed of links and clocks.</param>
/// <param name="Length">How long the run is sampled, from its start.</param>
public sealed record PeerGroupOptions(
    int Peers, LinkProfile Link, string Strategy = LateEventStrategies.Default, ulong Seed = 1, SimDuration Length = default)
{
    /// <summary>The interval of samples: 5 ms, the thesis's step.</summary>
    public static readonly SimDuration SampleInterval = SimDuration.FromMilliseconds(5);

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>The lead of the start after all peers are ready. Peers that hear of the start in time miss nothing.</summary>
    public SimDuration StartLead { get; init; } = SimDuration.FromMilliseconds(500);

    /// <summary>The bodies that players will spawn, which are compared in addition to the scene's own.</summary>
    public IReadOnlyList<BodyId> Spawned { get; init; } = [];

    /// <summary>The carrier of datagrams in real time. In virtual time nothing is protected: no datagram leaves the process.</summary>
    public Carrier Carrier { get; init; } = Carrier.Udp;

    /// <summary>
    /// Cancels a run in virtual time, in mid-step if need be, with an <see cref="System.OperationCanceledException"/>; default none. In
    /// real time the progress callback may end it with an exception.
    /// </summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>
    /// The host's options; clients take what applies to them. History is enough for every link, and timelines are kept for the whole run.
    /// </summary>
    internal HostOptions ToHostOptions() => new()
    {
        RejoinTime = SimDuration.Zero, // a peer that drops out is reported, not waited for
        Strategy = LateEventStrategies.OfName(Strategy),
        DisplayDelay = DisplayDelay,
        StartLead = StartLead,
        ExpectedClients = Peers - 1,
        PlayerBudget = null, // the measurement must not depend on its cost
        Window = new(LatencyCompensationWindow.MaxHistory),
        ExtraHistory = SimDuration.FromSeconds(60),
    };
}
