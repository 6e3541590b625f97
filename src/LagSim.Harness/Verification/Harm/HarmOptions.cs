using System;
using LagSim.Net.Sessions;

namespace LagSim.Harness.Verification.Harm;

/// <summary>Which attacks are drawn, and against what.</summary>
public sealed record HarmOptions
{
    /// <summary>How many attacks; default 200.</summary>
    public int Attacks { get; init; } = 200;

    /// <summary>The first attack's seed; each further one has the next. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>How many attacks are played at a time; default as many as there are processors.</summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>The host's budget for each player; null for none, to see what the attacks do then.</summary>
    public PlayerBudget? Budget { get; init; } = PlayerBudget.Default;

    /// <summary>How much work a second of virtual time each machine does, in units of about a microsecond; default 1,000,000.</summary>
    public double WorkPerSecond { get; init; } = 1e6;
}
