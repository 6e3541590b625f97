using System.Collections.Generic;
using System.Linq;
using MathNet.Numerics.Statistics;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>How a method at one setting does over scenes that were drawn at random. Immutable.</summary>
/// <param name="Method">The method.</param>
/// <param name="Setting">The setting, in words.</param>
/// <param name="ErrorKind">What the error is.</param>
/// <param name="Scenes">Over how many scenes; a setting that was too slow for one has fewer.</param>
/// <param name="Error">The error; not finite where one is not.</param>
/// <param name="Speed">Simulated seconds a second of CPU time.</param>
public sealed record WorkSpread(string Method, string Setting, string ErrorKind, int Scenes, SpreadOf Error, SpreadOf Speed)
{
    /// <summary>The spread over the scenes among them that were drawn; none where none was.</summary>
    public static IReadOnlyList<WorkSpread> Of(IReadOnlyList<WorkPoint> points) =>
    [
        .. points.Where(point => RandomHeapWork.IsDrawn(point.Scene)).GroupBy(point => (point.Method, point.Setting, point.ErrorKind))
            .Select(at => new WorkSpread(
                at.Key.Method, at.Key.Setting, at.Key.ErrorKind, at.Count(), SpreadOf.Over(at.Select(point => point.Error)),
                SpreadOf.Over(at.Select(point => point.Speed)))),
    ];
}

/// <summary>The least, the middle and the greatest of some numbers. Immutable.</summary>
/// <param name="Least">The least.</param>
/// <param name="Median">The middle one; the mean of the middle two of an even number.</param>
/// <param name="Greatest">The greatest.</param>
public readonly record struct SpreadOf(double Least, double Median, double Greatest)
{
    /// <summary>That of some numbers; NaN in all three where one of them is.</summary>
    internal static SpreadOf Over(IEnumerable<double> numbers)
    {
        double[] all = [.. numbers];
        return all.Any(double.IsNaN) ? new SpreadOf(double.NaN, double.NaN, double.NaN) : new SpreadOf(all.Min(), all.Median(), all.Max());
    }
}
