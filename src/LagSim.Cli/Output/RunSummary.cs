using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>How a run ended.</summary>
/// <param name="End">The world at the end.</param>
/// <param name="Until">The end.</param>
/// <param name="StartEnergy">Energy at the start, in joules.</param>
/// <param name="EndEnergy">Energy at the end, in joules.</param>
/// <param name="WallSeconds">The least time that the simulation alone took.</param>
internal sealed record RunSummary(Simulation End, SimTime Until, double StartEnergy, double EndEnergy, double WallSeconds);
