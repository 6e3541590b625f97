using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>Every strategy there is, by name.</summary>
public static class LateEventStrategies
{
    /// <summary>The strategy that is used where nothing else is said.</summary>
    public const string Default = "healing";

    /// <summary>All names, the simplest first.</summary>
    public static IReadOnlyList<string> Names { get; } = new[] { "none", "latency-forward", "interpolation", "full-rollback", "healing" };

    /// <summary>A new instance of the strategy of that name.</summary>
    /// <param name="name">One of <see cref="Names"/>.</param>
    /// <param name="displayDelay">
    /// How far behind shared time <c>interpolation</c> shows the world, 0 to 5 s; default 100 ms. The others show the present.
    /// </param>
    /// <exception cref="ArgumentException">There is none of that name, and the message lists what there is; or the delay is out of its range.</exception>
    public static ILateEventStrategy Create(string name, SimDuration? displayDelay = null) => name switch
    {
        "none" => new ApplyOnArrival(),
        "latency-forward" => new LatencyForward(),
        "interpolation" => new Interpolation(displayDelay),
        "full-rollback" => new FullRollback(),
        "healing" => new Healing(),
        _ => throw new ArgumentException($"There is no strategy '{name}'; there are {string.Join(", ", Names)}.", nameof(name)),
    };
}
