using System;
using System.Collections.Generic;
using System.Linq;
using MathNet.Numerics;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// A method's measured order on a scene: the slope of error against step, both logarithmic, by least squares over the asymptotic part.
/// Immutable.
/// </summary>
/// <remarks>
/// The asymptotic part is chosen by a rule that knows no result: of the points whose error is at least a hundred times the scene's rounding
/// and at most a tenth of its size, the finest four, at least three. There is no order where fewer are left.
/// </remarks>
/// <param name="Scene">The scene.</param>
/// <param name="Method">The method.</param>
/// <param name="Slope">The order; 1 means that half the step gives half the error.</param>
/// <param name="Points">The number of points used.</param>
public sealed record WorkOrder(string Scene, string Method, double Slope, int Points)
{
    /// <summary>The most points used.</summary>
    public const int Most = 4;

    private const int Fewest = 3;

    /// <summary>
    /// Measures the order of a method on a scene from its points of one kind of error; null if too few are in the asymptotic part.
    /// </summary>
    internal static WorkOrder? Of(WorkScene scene, IEnumerable<WorkPoint> points)
    {
        WorkPoint[] part =
        [
            .. points.Where(p => p.StepSeconds > 0 && p.Error >= scene.Rounding && p.Error <= 0.1 * scene.Ceiling).OrderBy(p => p.StepSeconds).Take(Most),
        ];
        return part.Length < Fewest
            ? null
            : new WorkOrder(
                scene.Name, part[0].Method, Fit.Line([.. part.Select(p => Math.Log(p.StepSeconds))], [.. part.Select(p => Math.Log(p.Error))]).B, part.Length);
    }
}
