using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>How a run ended.</summary>
/// <param name="End">The world at the end.</param>
/// <param name="Until">The end.</param>
/// <param name="StartEnergy">Energy at the start, in joules.</param>
/// <param name="EndEnergy">Energy at the end, in joules.</param>
/// <param name="WallSeconds">The least time that the simulation alone took; if none was timed, what the one that was written took.</param>
internal sealed record RunSummary(Simulation End, SimTime Until, double StartEnergy, double EndEnergy, double WallSeconds)
{
    /// <summary>How many runs were timed, after the one that was written; 0 for none.</summary>
    internal int Timed { get; init; }

    /// <summary>The wall clock of the run that was written, with its writing.</summary>
    internal double WritingSeconds { get; init; }

    /// <summary>The wall clock of all runs that were timed.</summary>
    internal double TimingSeconds { get; init; }

    /// <summary>The wall-clock time of the chart: one more run, and drawing; zero without one.</summary>
    internal double PictureSeconds { get; init; }
}
