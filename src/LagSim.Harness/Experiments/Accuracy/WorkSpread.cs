using System.Collections.Generic;
using System.Linq;
using MathNet.Numerics.Statistics;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>The results of a method at one setting over several random scenes. Immutable.</summary>
/// <param name="Method">The method.</param>
/// <param name="Setting">The setting, in words.</param>
/// <param name="ErrorKind">The kind of error.</param>
/// <param name="Scenes">The number of scenes. Scenes for which the setting was too slow are not counted.</param>
/// <param name="Error">The error; not finite where one is not.</param>
/// <param name="Speed">Simulated seconds per second of CPU time.</param>
public sealed record WorkSpread(string Method, string Setting, string ErrorKind, int Scenes, SpreadOf Error, SpreadOf Speed)
{
    /// <summary>Returns the spreads of the points on random scenes; empty if there are none.</summary>
    public static IReadOnlyList<WorkSpread> Of(IReadOnlyList<WorkPoint> points) =>
    [
        .. points.Where(point => RandomHeapWork.IsDrawn(point.Scene)).GroupBy(point => (point.Method, point.Setting, point.ErrorKind))
            .Select(at => new WorkSpread(
                at.Key.Method, at.Key.Setting, at.Key.ErrorKind, at.Count(), SpreadOf.Over(at.Select(point => point.Error)),
                SpreadOf.Over(at.Select(point => point.Speed)))),
    ];
}

/// <summary>The minimum, the median and the maximum of some numbers. Immutable.</summary>
/// <param name="Least">The least.</param>
/// <param name="Median">The middle one; the mean of the middle two of an even number.</param>
/// <param name="Greatest">The greatest.</param>
public readonly record struct SpreadOf(double Least, double Median, double Greatest)
{
    /// <summary>Returns the spread of some numbers; all NaN if any of them is.</summary>
    internal static SpreadOf Over(IEnumerable<double> numbers)
    {
        double[] all = [.. numbers];
        return all.Any(double.IsNaN) ? new SpreadOf(double.NaN, double.NaN, double.NaN) : new SpreadOf(all.Min(), all.Median(), all.Max());
    }
}
