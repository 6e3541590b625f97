using System.Collections.Generic;
using LagSim.Harness.Experiments.Accuracy;

namespace LagSim.Cli.Output;

/// <summary>All that <c>lagsim accuracy</c> found out, however it is told. Immutable.</summary>
/// <param name="Scenes">The scenes.</param>
/// <param name="Work">The points, the orders, and what was left out.</param>
/// <param name="IsQuick">Whether it was but a quick look.</param>
/// <param name="Seed">What the document begins with; nothing here is drawn by it.</param>
internal sealed record AccuracyReport(IReadOnlyList<WorkScene> Scenes, WorkReport Work, bool IsQuick, ulong Seed)
{
    /// <summary>The spread over heaps that were drawn; empty where none was.</summary>
    internal IReadOnlyList<WorkSpread> Spread { get; } = WorkSpread.Of(Work.Points);

    /// <summary>Whether a scene is one of those heaps, and so is told of by their spread.</summary>
    internal bool IsDrawn(WorkScene scene) => scene.Name.StartsWith(WorkScenes.Drawn + "-", System.StringComparison.Ordinal);

    /// <summary>What an order is called in JSON: by its method, and by its scene too where there are several.</summary>
    internal string NameOf(WorkOrder order) => Scenes.Count == 1 ? order.Method : $"{order.Scene}: {order.Method}";
}
