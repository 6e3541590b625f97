using System;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>The options of random sessions with stalls.</summary>
public sealed record StallOptions
{
    /// <summary>The number of sessions; default 200.</summary>
    public int Sessions { get; init; } = 200;

    /// <summary>The seed of the first session. Each further one has the next. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>The number of sessions played at a time; default the number of processors.</summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>The strategy of the peers for late events. Another than the default shows that the check finds differences.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>
    /// Whether a killed client keeps its pass. Without it, the check must find that the client comes back as another player.
    /// </summary>
    public bool KeepsPasses { get; init; } = true;

    /// <summary>
    /// How long a client that lost its host asks to rejoin, in seconds. With 0, the check must find that the client does not come back.
    /// </summary>
    public double RejoinSeconds { get; init; } = 120;

    /// <summary>
    /// The number of accepted log entries that each client's check ignores, from the 5th on, to show that lost events are found.
    /// </summary>
    public int Overlooked { get; init; }

    /// <summary>Called with each session that a client opens, before its first step, for tests that inject faults.</summary>
    internal Action<ClientSession>? PrepareClient { get; init; }
}
