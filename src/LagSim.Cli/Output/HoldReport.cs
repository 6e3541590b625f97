using System.Collections.Generic;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;

namespace LagSim.Cli.Output;

/// <summary>The results of <c>lagsim hold</c>. Immutable.</summary>
/// <param name="Motion">The motion of the hand.</param>
/// <param name="Runs">The sessions, one for each link.</param>
/// <param name="Predictions">The prediction errors of that motion from all of its samples, by their age.</param>
/// <param name="Seed">The seed of all random numbers.</param>
internal sealed record HoldReport(HandMotion Motion, IReadOnlyList<HoldRun> Runs, IReadOnlyList<PredictionError> Predictions, ulong Seed);
