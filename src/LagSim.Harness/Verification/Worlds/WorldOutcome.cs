using System.Collections.Generic;
using LagSim.Testing;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>The outcome of one world.</summary>
public sealed record WorldOutcome
{
    /// <summary>The seed.</summary>
    public required ulong Seed { get; init; }

    /// <summary>The kind of world.</summary>
    public required WorldKind Kind { get; init; }

    /// <summary>The number of acts of players.</summary>
    public int Acts { get; init; }

    /// <summary>The number of acts at the very tick of an impact, a step or a crossing, or next to it.</summary>
    public int ActsAtEvents { get; init; }

    /// <summary>How often two players acted on one awake body within a tenth of a second.</summary>
    public int Meetings { get; init; }

    /// <summary>The number of events in all its plays.</summary>
    public long Events { get; init; }

    /// <summary>The number of compared states, hashes and timeline entries.</summary>
    public long Compared { get; init; }

    /// <summary>The number of bodies that left the world because they could not be followed.</summary>
    public int LostBodies { get; init; }

    /// <summary>Whether it took more events than it may, so that not all was compared.</summary>
    public bool IsUnfinished { get; init; }

    /// <summary>Whether its timelines were full.</summary>
    public bool HasFullTimelines { get; init; }

    /// <summary>How it failed.</summary>
    public WorldFailureKind FailureKind { get; init; }

    /// <summary>The name of the broken promise; empty if none is.</summary>
    public string Promise { get; init; } = "";

    /// <summary>The failure, as a sentence; null if there is none.</summary>
    public string? Failure { get; init; }

    /// <summary>The first event that differs; null if none does.</summary>
    public FirstDifference? Difference { get; init; }

    /// <summary>The least acts that were found to fail, one a line; empty if they were not looked for.</summary>
    public IReadOnlyList<string> LeastActs { get; init; } = [];

    /// <summary>The command that plays it again.</summary>
    public string Command => $"lagsim check --worlds 1 --seed {Seed}";
}
