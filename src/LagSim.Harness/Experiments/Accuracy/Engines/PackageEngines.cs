using System.Collections.Generic;
#if WITH_PEERS
using LagSim.Harness.Experiments.Accuracy.Engines.Packages;
#endif

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>
/// The engines that come as packages, which some registries lack. Built with <c>-p:WithPeers=true</c>, and reported as missing otherwise.
/// </summary>
internal static class PackageEngines
{
    internal static IReadOnlyList<IWorkMethod> All { get; } =
#if WITH_PEERS
        [new JitterMethod(), new BepuMethod(), new Box2DMethod()];
#else
        [new NotBuilt("Jitter2", "jitter", "Jitter2.Double"), new NotBuilt("BepuPhysics", "bepu", "BepuPhysics"),
            new NotBuilt("Box2D.NET", "box2d", "Box2D.NET")];

    /// <summary>An engine that this build does not have: its name, and how to get it.</summary>
    private sealed class NotBuilt(string name, string engine, string package) : SteppedEngine
    {
        public override string Name => name;

        public override string Engine => engine;

        public override string? Missing => $"it is not in this build; -p:WithPeers=true builds it in and needs the package {package}";

        protected override Run Begin(WorkScene scene, double step) => throw new System.InvalidOperationException(Missing);
    }
#endif
}
