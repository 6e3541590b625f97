using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The results of speed against error. Immutable.</summary>
/// <param name="Points">Every scene, method, setting and kind of error, in that order.</param>
/// <param name="Orders">The measured order of each method that has steps.</param>
/// <param name="LeftOut">The omissions and their reasons, a sentence each, with missing engines among them.</param>
public sealed record WorkReport(IReadOnlyList<WorkPoint> Points, IReadOnlyList<WorkOrder> Orders, IReadOnlyList<string> LeftOut)
{
    /// <summary>
    /// The scene and method at which the sweep was cancelled, which is left out with all after it; null if it was not.
    /// </summary>
    public string? StoppedAt { get; init; }
}
