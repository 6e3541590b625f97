using System;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>Which sessions with stalls are drawn.</summary>
public sealed record StallOptions
{
    /// <summary>How many sessions; default 200.</summary>
    public int Sessions { get; init; } = 200;

    /// <summary>The first session's seed; each further one has the next. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>How many sessions are played at a time; default as many as there are processors.</summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>What peers do with late events; another than the default is to see that the check finds what does not agree.</summary>
    public string Strategy { get; init; } = LateEventStrategies.Default;

    /// <summary>
    /// Whether who is killed keeps its pass; without, it is to be seen that the check finds who comes back as somebody else.
    /// </summary>
    public bool KeepsPasses { get; init; } = true;

    /// <summary>
    /// For how long who lost the other asks to be let in again, in seconds; 0 is to see that the check finds who does not come back.
    /// </summary>
    public double RejoinSeconds { get; init; } = 120;

    /// <summary>
    /// How many of its accepted entries of the log each client's check overlooks, from the 5th on; to see that what is lost is found.
    /// </summary>
    public int Overlooked { get; init; }

    /// <summary>Called with each session that a client opens, before it is stepped; for tests, to put in a fault.</summary>
    internal Action<ClientSession>? PrepareClient { get; init; }
}
