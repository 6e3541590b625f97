using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Accuracy.Engines;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The methods of the work-precision diagrams.</summary>
public static class WorkMethods
{
    /// <summary>All methods, LagSim's own first.</summary>
    public static IReadOnlyList<IWorkMethod> All { get; } =
    [
        new LagSimMethod(MotionLaw.Ballistic),
        new LagSimMethod(MotionLaw.ClosedForm),
        new LagSimMethod(MotionLaw.RungeKutta4, hasFixedSteps: true),
        new LagSimMethod(MotionLaw.DormandPrince54),
        new LagSimMethod(MotionLaw.DormandPrince54, hasFixedSteps: true),
        new MathNetMethod(),
        new OdeMethod(),
        new OdeMethod(isDirect: true),
        new ChipmunkMethod(),
        .. PackageEngines.All,
    ];

    /// <summary>The engines other than LagSim, each once.</summary>
    public static IReadOnlyList<string> Peers { get; } = [.. All.Select(method => method.Engine).Where(engine => engine != LagSimMethod.EngineName).Distinct()];
}
