using System;
using LagSim.Net.Sessions;

namespace LagSim.Harness.Verification.Harm;

/// <summary>The options of random attacks.</summary>
public sealed record HarmOptions
{
    /// <summary>The number of attacks; default 200.</summary>
    public int Attacks { get; init; } = 200;

    /// <summary>The seed of the first attack. Each further one has the next. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>The number of attacks played at a time; default the number of processors.</summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>The host's budget for each player; null for none, to show what the attacks do then.</summary>
    public PlayerBudget? Budget { get; init; } = PlayerBudget.Default;

    /// <summary>The work that each machine does per second of virtual time, in units of about a microsecond; default 1,000,000.</summary>
    public double WorkPerSecond { get; init; } = 1e6;
}
