using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>The list of strategies, and the name of each on the command line and in reports.</summary>
internal static class LateEventStrategies
{
    /// <summary>The name of the default strategy.</summary>
    internal const string Default = "healing";

    /// <summary>All names, the simplest first.</summary>
    internal static IReadOnlyList<string> Names { get; } = new[] { "none", "latency-forward", "interpolation", "full-rollback", "healing" };

    /// <summary>Returns the strategy of that name.</summary>
    /// <param name="name">One of <see cref="Names"/>.</param>
    /// <exception cref="ArgumentException">There is no strategy of that name; the message lists those that exist.</exception>
    internal static LateEventStrategy OfName(string name) => name switch
    {
        "none" => LateEventStrategy.ApplyOnArrival,
        "latency-forward" => LateEventStrategy.LatencyForward,
        "interpolation" => LateEventStrategy.Interpolation,
        "full-rollback" => LateEventStrategy.FullRollback,
        "healing" => LateEventStrategy.Healing,
        _ => throw new ArgumentException($"There is no strategy '{name}'; there are {string.Join(", ", Names)}.", nameof(name)),
    };

    /// <summary>Creates an instance of a strategy.</summary>
    /// <param name="strategy">The strategy.</param>
    /// <param name="displayDelay">
    /// How far behind shared time interpolation shows the world, 0 to 5 s; default 100 ms. The others show the present.
    /// </param>
    /// <exception cref="ArgumentException">There is no such strategy, or the delay is out of range.</exception>
    internal static ILateEventStrategy Create(LateEventStrategy strategy, SimDuration? displayDelay = null) => strategy switch
    {
        LateEventStrategy.ApplyOnArrival => new ApplyOnArrival(),
        LateEventStrategy.LatencyForward => new LatencyForward(),
        LateEventStrategy.Interpolation => new Interpolation(displayDelay),
        LateEventStrategy.FullRollback => new FullRollback(),
        LateEventStrategy.Healing => new Healing(),
        _ => throw new ArgumentOutOfRangeException(
            nameof(strategy),
            strategy,
            $"There is no such strategy; there are {string.Join(", ", Enum.GetNames(typeof(LateEventStrategy)))}."),
    };

    /// <summary>Creates an instance of the strategy of that name.</summary>
    /// <exception cref="ArgumentException">
    /// There is no strategy of that name, and the message lists those that exist; or the delay is out of range.
    /// </exception>
    internal static ILateEventStrategy Create(string name, SimDuration? displayDelay = null) => Create(OfName(name), displayDelay);
}
