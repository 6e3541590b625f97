using System.Collections.Generic;
using System.Threading;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>How the peers of a test are connected and watched.</summary>
/// <param name="Peers">How many, the host included; 2 to 9.</param>
/// <param name="Link">The link of each client to the host.</param>
/// <param name="Strategy">What all do with late events.</param>
/// <param name="Seed">The luck of links and clocks.</param>
/// <param name="Length">How long the run is watched, from its start.</param>
public sealed record PeerGroupOptions(
    int Peers, LinkProfile Link, string Strategy = LateEventStrategies.Default, ulong Seed = 1, SimDuration Length = default)
{
    /// <summary>How far apart samples are: 5 ms, the thesis's step.</summary>
    public static readonly SimDuration SampleInterval = SimDuration.FromMilliseconds(5);

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;

    /// <summary>How long after everybody is ready the scene starts: who hears of the start in time misses nothing.</summary>
    public SimDuration StartLead { get; init; } = SimDuration.FromMilliseconds(500);

    /// <summary>Bodies that players will spawn, to be compared beside the scene's own.</summary>
    public IReadOnlyList<BodyId> Spawned { get; init; } = [];

    /// <summary>What carries datagrams in real time.</summary>
    public Carrier Carrier { get; init; } = Carrier.Udp;

    /// <summary>
    /// Ends a run in virtual time, in the middle of a step if need be, by an <see cref="System.OperationCanceledException"/>; default
    /// none. In real time whoever is told of progress ends it.
    /// </summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>
    /// The host's options, of which clients take what concerns them: history enough for every link, timelines kept for the whole run.
    /// </summary>
    internal HostOptions ToHostOptions() => new()
    {
        RejoinTime = SimDuration.Zero, // a peer that drops out is told, not waited for
        Strategy = LateEventStrategies.OfName(Strategy),
        DisplayDelay = DisplayDelay,
        StartLead = StartLead,
        ExpectedClients = Peers - 1,
        PlayerBudget = null, // what is measured is not to depend on what it costs
        Window = new(LatencyCompensationWindow.MaxHistory),
        ExtraHistory = SimDuration.FromSeconds(60),
    };
}
