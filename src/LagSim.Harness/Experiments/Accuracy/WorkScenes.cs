using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Linq;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The scenes of the work-precision diagrams.</summary>
public static class WorkScenes
{
    /// <summary>All of them.</summary>
    public static IReadOnlyList<WorkScene> All { get; } =
    [
        new DropWork(), new Elastic49Work(), new GasWork(), new DragWork(), new KeplerWork(), new SpringWork(), new BilliardsWork(),
        new HeapWork(), new PyramidWork(), new ShaftWork(), new HopperWork(),
    ];

    /// <summary>The name of the random heaps, which are no part of <see cref="All"/>.</summary>
    public static string Drawn => RandomHeapWork.Set;

    /// <summary>Returns the random heaps of a seed.</summary>
    public static IReadOnlyList<WorkScene> Draw(ulong seed) => RandomHeapWork.Draw(seed);

    /// <summary>Returns the scene of a name.</summary>
    public static bool TryGet(string name, [NotNullWhen(true)] out WorkScene? found)
    {
        found = All.FirstOrDefault(scene => scene.Name == name);
        return found is not null;
    }
}
