using System.Collections.Generic;
using LagSim.Harness.Experiments.Accuracy;

namespace LagSim.Cli.Output;

/// <summary>The results of <c>lagsim accuracy</c>. Immutable.</summary>
/// <param name="Scenes">The scenes.</param>
/// <param name="Work">The points, the orders, and the omissions.</param>
/// <param name="IsQuick">Whether it was only a quick look.</param>
/// <param name="Seed">The seed that the document begins with. No figure here depends on it.</param>
internal sealed record AccuracyReport(IReadOnlyList<WorkScene> Scenes, WorkReport Work, bool IsQuick, ulong Seed)
{
    /// <summary>The spread over random heaps; empty if there are none.</summary>
    internal IReadOnlyList<WorkSpread> Spread { get; } = WorkSpread.Of(Work.Points);

    /// <summary>Whether a scene is one of the random heaps, which are reported by their spread.</summary>
    internal bool IsDrawn(WorkScene scene) => scene.Name.StartsWith(WorkScenes.Drawn + "-", System.StringComparison.Ordinal);

    /// <summary>The JSON name of an order: by its method, and by its scene where there are several.</summary>
    internal string NameOf(WorkOrder order) => Scenes.Count == 1 ? order.Method : $"{order.Scene}: {order.Method}";
}
