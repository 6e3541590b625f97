using System.Collections.Generic;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>What came of holding speed against error. Immutable.</summary>
/// <param name="Points">Every scene, method, setting and kind of error, in that order.</param>
/// <param name="Orders">The measured order of each method that has steps.</param>
/// <param name="LeftOut">What was left out and why, a sentence each; missing engines among them.</param>
public sealed record WorkReport(IReadOnlyList<WorkPoint> Points, IReadOnlyList<WorkOrder> Orders, IReadOnlyList<string> LeftOut)
{
    /// <summary>
    /// Where it was stopped before all was done, a scene and a method, which is left out with all after it; null if it went through.
    /// </summary>
    public string? StoppedAt { get; init; }
}
