using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>The options of one run: one strategy on one link, in virtual time.</summary>
/// <param name="Scene">The scene.</param>
/// <param name="Plan">The players' actions.</param>
/// <param name="Strategy">The strategy of all peers for late events.</param>
/// <param name="Link">The link of each client to the host.</param>
public sealed record CompareOptions(Scene Scene, IReadOnlyList<PlannedAction> Plan, string Strategy, LinkProfile Link)
{
    /// <summary>The length of a run from the start of the scene: the players' six seconds, and time for the last events.</summary>
    public static readonly SimDuration Length = SimDuration.FromSeconds(12);

    /// <summary>The most bodies, spawned ones included, since every state of every peer is kept.</summary>
    public const int MaxBodies = 500;

    /// <summary>The number of peers, the host included; 2 to 9.</summary>
    public int Peers { get; init; } = 4;

    /// <summary>The seed of links and clocks.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>Cancels a run, in mid-step if need be, with an <see cref="OperationCanceledException"/>; default none.</summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;
}
