using System;
using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>What is checked: which sessions are drawn, and what of them is played.</summary>
public sealed record CheckOptions
{
    /// <summary>The fewest peers of a session, the host included.</summary>
    public const int FewestPeers = 2;

    /// <summary>The most peers of a session, the host included.</summary>
    public const int MaxPeers = 8;

    /// <summary>How many sessions, at least 1; default 1,000.</summary>
    public int Sessions { get; init; } = 1000;

    /// <summary>The seed of the first session; the next has the next number. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>How many peers a session begins with at least, <see cref="FewestPeers"/> to <see cref="ToPeers"/>; default 2.</summary>
    public int FromPeers { get; init; } = FewestPeers;

    /// <summary>How many at most, up to <see cref="MaxPeers"/>; default 8.</summary>
    public int ToPeers { get; init; } = MaxPeers;

    /// <summary>
    /// The link of every client; null, the default: each has its own, drawn from all profiles and all pure delays of 0 to 2 s.
    /// </summary>
    public LinkProfile? Profile { get; init; }

    /// <summary>What peers do with late events, one of <see cref="LateEventStrategies.Names"/>.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>The scene's bodies that take part, by their index in the scene as it was drawn; null, the default: all.</summary>
    public IReadOnlyList<int>? Bodies { get; init; }

    /// <summary>What players do of all that was drawn, by index; null, the default: all.</summary>
    public IReadOnlyList<int>? Events { get; init; }

    /// <summary>
    /// How many sessions are played at a time, at least 1; default as many as there are processors. It changes no figure but times.
    /// </summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>
    /// How often a failing session is played again, smaller, to find the least that still fails; 0 leaves it whole. Default 200.
    /// </summary>
    public int ShrinkingPlays { get; init; } = 200;

    /// <summary>How late an event may be; null, the default: as late as the session's links need. A test has it too short.</summary>
    internal SimDuration? History { get; init; }

    /// <summary>
    /// Gets each peer's number in its session and the session itself, before its first step: for faults put in on purpose.
    /// </summary>
    internal Action<int, Session>? PrepareSession { get; init; }

    /// <summary>
    /// What the world that has all events before it begins is run with, of what is usual: for a fault that changes what is right, not only
    /// how it is healed.
    /// </summary>
    internal Func<SimulationOptions, SimulationOptions> PrepareAlone { get; init; } = static options => options;
}
