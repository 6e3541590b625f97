using System;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>How thorough the sweep of speed against error is. Immutable.</summary>
public sealed record WorkOptions
{
    /// <summary>The options of a quick look: few settings and short runs, some seconds in all.</summary>
    public static WorkOptions Quick { get; } = new() { MaxSettings = 3, LongestSeconds = 0.15, TimingSeconds = 0.02, FewestRuns = 1 };

    /// <summary>The most settings of a method and scene, from the coarsest on.</summary>
    public int MaxSettings { get; init; } = int.MaxValue;

    /// <summary>
    /// A setting whose single run would by its coarser neighbour take longer than this, in seconds, is left out, and so are all finer ones;
    /// default 20.
    /// </summary>
    public double LongestSeconds { get; init; } = 20;

    /// <summary>
    /// A run that is not done after this long, in seconds, is broken off, and its setting is left out with all finer ones: three times
    /// <see cref="LongestSeconds"/>, but a minute at least, since nothing foretells how long the first setting takes.
    /// </summary>
    public double BreakOffSeconds => Math.Max(60, 3 * LongestSeconds);

    /// <summary>Runs are repeated until they have taken this long together, in seconds; default 0.3.</summary>
    public double TimingSeconds { get; init; } = 0.3;

    /// <summary>The least number of repeats, but one for a run of more than a second; default 3.</summary>
    public int FewestRuns { get; init; } = 3;
}
