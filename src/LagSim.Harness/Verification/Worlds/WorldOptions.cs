using System;
using System.Collections.Generic;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>The options of a check of single worlds.</summary>
public sealed record WorldOptions
{
    /// <summary>The number of worlds, at least 1; default 500.</summary>
    public int Worlds { get; init; } = 500;

    /// <summary>The seed of the first world. Each further one has the next number. Default 1.</summary>
    public ulong Seed { get; init; } = 1;

    /// <summary>The number of worlds played at a time, at least 1; default the number of processors. It changes only the time
    /// taken.</summary>
    public int Workers { get; init; } = Environment.ProcessorCount;

    /// <summary>
    /// The most replays of a failing world to find the least acts that still fail; 0 does not shrink it. Default 60.
    /// </summary>
    public int ShrinkingPlays { get; init; } = 60;

    /// <summary>The most events of a world that has everything on time; one that needs more counts as unfinished. Default 60,000.</summary>
    public long MaxEvents { get; init; } = 60_000;

    /// <summary>Changes the options of the world that has everything on time, for tests that break a promise on purpose.</summary>
    internal Func<SimulationOptions, SimulationOptions> PrepareOnTime { get; init; } = static options => options;

    /// <summary>Changes the options of the worlds that hear of events late, for tests that inject faults into healing.</summary>
    internal Func<SimulationOptions, SimulationOptions> PrepareLate { get; init; } = static options => options;

    /// <summary>Changes the snapshot from which a world goes on, for tests in which it lacks something.</summary>
    internal Func<WorldSnapshot, WorldSnapshot> PrepareSnapshot { get; init; } = static snapshot => snapshot;

    /// <summary>The promises that are held to a world; a test adds its own.</summary>
    internal Func<WorldScene, IReadOnlyList<WorldPromise>> Promises { get; init; } = WorldPromise.All;
}
