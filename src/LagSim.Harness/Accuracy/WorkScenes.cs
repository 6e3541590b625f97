using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Linq;

namespace LagSim.Harness.Accuracy;

/// <summary>The scenes of the work-precision diagrams.</summary>
public static class WorkScenes
{
    /// <summary>All of them.</summary>
    public static IReadOnlyList<WorkScene> All { get; } =
    [
        new DropWork(), new Elastic49Work(), new GasWork(), new DragWork(), new KeplerWork(), new SpringWork(), new BilliardsWork(),
        new HeapWork(), new PyramidWork(), new ShaftWork(), new HopperWork(),
    ];

    /// <summary>The scene of that name.</summary>
    public static bool TryGet(string name, [NotNullWhen(true)] out WorkScene? found)
    {
        found = All.FirstOrDefault(scene => scene.Name == name);
        return found is not null;
    }
}
