using System.Collections.Generic;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;

namespace LagSim.Cli.Output;

/// <summary>The results of <c>lagsim hold</c>. Immutable.</summary>
/// <param name="Motion">How the hand moved.</param>
/// <param name="Runs">The sessions, one for each link.</param>
/// <param name="Predictions">How well that motion can be predicted from all of its samples, by how old they are.</param>
/// <param name="Seed">The seed of all random numbers.</param>
internal sealed record HoldReport(HandMotion Motion, IReadOnlyList<HoldRun> Runs, IReadOnlyList<PredictionError> Predictions, ulong Seed);
