using System;
using System.Collections.Generic;

namespace LagSim.Net.Strategies;

/// <summary>Every strategy there is, by name.</summary>
public static class LateEventStrategies
{
    /// <summary>The strategy that is used where nothing else is said.</summary>
    public const string Default = "healing";

    /// <summary>All names, the simplest first.</summary>
    public static IReadOnlyList<string> Names { get; } = new[] { "none", "latency-forward", "full-rollback", "healing" };

    /// <summary>A new instance of the strategy of that name.</summary>
    /// <exception cref="ArgumentException">There is none; the message lists what there is.</exception>
    public static ILateEventStrategy Create(string name) => name switch
    {
        "none" => new ApplyOnArrival(),
        "latency-forward" => new LatencyForward(),
        "full-rollback" => new FullRollback(),
        "healing" => new Healing(),
        _ => throw new ArgumentException($"There is no strategy '{name}'; there are {string.Join(", ", Names)}.", nameof(name)),
    };
}
