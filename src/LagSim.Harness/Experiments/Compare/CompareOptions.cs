using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>One strategy on one link, in virtual time.</summary>
/// <param name="Scene">What is played in.</param>
/// <param name="Plan">What the players do.</param>
/// <param name="Strategy">What they all do with late events.</param>
/// <param name="Link">The link of each client to the host.</param>
public sealed record CompareOptions(Scene Scene, IReadOnlyList<PlannedAction> Plan, string Strategy, LinkProfile Link)
{
    /// <summary>How long a run takes from the start of the scene: the players' six seconds, and time for the last of the events.</summary>
    public static readonly SimDuration Length = SimDuration.FromSeconds(12);

    /// <summary>The most bodies that are watched, spawned ones included: every state of every peer is kept.</summary>
    public const int MaxBodies = 500;

    /// <summary>How many peers, the host included; 2 to 9.</summary>
    public int Peers { get; init; } = 4;

    /// <summary>The luck of links and clocks.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>Ends a run, in the middle of a step if need be, by an <see cref="OperationCanceledException"/>; default none.</summary>
    public CancellationToken Cancellation { get; init; }

    /// <summary>How far behind shared time <c>interpolation</c> shows the world.</summary>
    public SimDuration DisplayDelay { get; init; } = Interpolation.DefaultDelay;
}
