using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>The end of a run.</summary>
/// <param name="End">The world at the end.</param>
/// <param name="Until">The time of the end.</param>
/// <param name="StartEnergy">The energy at the start, in joules.</param>
/// <param name="EndEnergy">The energy at the end, in joules.</param>
/// <param name="WallSeconds">The least time of the simulation alone, in seconds; if no run was timed, the time of the one that was
/// written.</param>
internal sealed record RunSummary(Simulation End, SimTime Until, double StartEnergy, double EndEnergy, double WallSeconds)
{
    /// <summary>The number of timed runs, after the one that was written; 0 for none.</summary>
    internal int Timed { get; init; }

    /// <summary>The wall-clock time of the run that was written, including the writing.</summary>
    internal double WritingSeconds { get; init; }

    /// <summary>The wall-clock time of all timed runs.</summary>
    internal double TimingSeconds { get; init; }

    /// <summary>The wall-clock time of the chart: one more run, and drawing; zero without one.</summary>
    internal double DrawingSeconds { get; init; }
}
