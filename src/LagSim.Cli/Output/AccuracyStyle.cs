using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Cli.Output;

/// <summary>
/// The style of a method, the same in every chart: its colour and shape. LagSim's are cool and filled, all others warm or grey and open.
/// </summary>
/// <param name="Colour">The palette slot.</param>
/// <param name="Shape">The marker of its points.</param>
/// <param name="IsOwn">Whether it is LagSim's, and so drawn with a strong, solid line.</param>
internal sealed record AccuracyStyle(int Colour, PointShape Shape, bool IsOwn)
{
    // In the order of the methods: Ballistic, ClosedForm, RungeKutta4, DormandPrince54, the same with fixed steps; MathNet, ODE by either
    // stepper, Chipmunk, Jitter2, BepuPhysics, Box2D.
    private static readonly int[] Colours = [7, 0, 2, 8, 5, 6, 1, 11, 3, 4, 9, 10];

    private static readonly PointShape[] Shapes =
    [
        PointShape.Disc, PointShape.Diamond, PointShape.Square, PointShape.Triangle, PointShape.TriangleDown, PointShape.Plus, PointShape.OpenSquare,
        PointShape.OpenTriangleDown, PointShape.Cross, PointShape.OpenTriangle, PointShape.OpenDiamond, PointShape.Circle,
    ];

    /// <summary>Returns the style of the method with an index in <see cref="WorkMethods.All"/>.</summary>
    internal static AccuracyStyle Of(int method) => new(
        Colours[method], Shapes[method], WorkMethods.All[method].Engine == WorkMethods.All[0].Engine);
}
