using System;
using System.Collections.Generic;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>The options of a check: the sessions to draw, and the parts of them to play.</summary>
public sealed record CheckOptions
{
    /// <summary>The fewest peers of a session, the host included.</summary>
    public const int FewestPeers = 2;

    /// <summary>The most peers of a session, the host included.</summary>
    public const int MaxPeers = 8;

    /// <summary>The number of sessions, at least 1; default 1,000.</summary>
    public int Sessions { get; init; } = 1000;

    /// <summary>The seed of the first session. Each further one has the next number. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>
    /// The least number of peers at the start of a session, <see cref="FewestPeers"/> to <see cref="ToPeers"/>; default 2.
    /// </summary>
    public int FromPeers { get; init; } = FewestPeers;

    /// <summary>The largest number of peers at the start of a session, up to <see cref="MaxPeers"/>; default 8.</summary>
    public int ToPeers { get; init; } = MaxPeers;

    /// <summary>
    /// The link of every client; null, the default, draws each client's from all profiles and all pure delays of 0 to 2 s.
    /// </summary>
    public LinkProfile? Profile { get; init; }

    /// <summary>The strategy of the peers for late events, one of <see cref="LateEventStrategies.Names"/>.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>Which sessions have rules; default some.</summary>
    public RulesOfSessions Rules { get; init; }

    /// <summary>The scene's bodies that take part, by their index when drawn; null, the default, for all.</summary>
    public IReadOnlyList<int>? Bodies { get; init; }

    /// <summary>The drawn actions that are performed, by index; null, the default, for all.</summary>
    public IReadOnlyList<int>? Events { get; init; }

    /// <summary>
    /// The most events in all worlds of a session, re-simulated ones included; one that needs more counts as unfinished, and is no failure.
    /// Default two million, which took 5 GB in the one that was measured; the mean is 14,000.
    /// </summary>
    public long MaxEvents { get; init; } = 2_000_000;

    /// <summary>
    /// The number of sessions played at a time, at least 1; default the number of processors. It changes only the time taken.
    /// </summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>
    /// The most replays of a failing session to find the least that still fails; 0 does not shrink it. Default 200.
    /// </summary>
    public int ShrinkingPlays { get; init; } = 200;

    /// <summary>
    /// The latest allowed lateness of events; null, the default, for what the session's links need. A test sets it too short.
    /// </summary>
    internal SimDuration? History { get; init; }

    /// <summary>
    /// Called with each peer's number and session before its first step, for tests that inject faults.
    /// </summary>
    internal Action<int, Session>? PrepareSession { get; init; }

    /// <summary>
    /// Changes the options of the reference, which has all events before it begins: for faults that change the right result, not only how
    /// it is healed.
    /// </summary>
    internal Func<SimulationOptions, SimulationOptions> PrepareAlone { get; init; } = static options => options;
}
