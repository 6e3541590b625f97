using System;
using System.Collections.Generic;
using System.Linq;
using MathNet.Numerics.Statistics;

namespace LagSim.Harness.Experiments.Metrics;

/// <summary>The median, the 99th percentile and the maximum of a list of values.</summary>
/// <remarks>
/// Immutable, safe on any thread. The unit is that of the values, most often milliseconds. Between two values the quantile is interpolated
/// by definition R-7, the default of NumPy, R and spreadsheets, so the figure can be checked from the CSV.
/// </remarks>
/// <param name="P50">The median; 0 without a value.</param>
/// <param name="P99">The 99th percentile; 0 without a value.</param>
/// <param name="Max">The largest value; 0 without a value.</param>
public readonly record struct Percentiles(double P50, double P99, double Max)
{
    /// <summary>The percentiles of these values, in any order; all zero where there are none.</summary>
    /// <exception cref="ArgumentNullException"><paramref name="values"/> is null.</exception>
    /// <exception cref="ArgumentOutOfRangeException">A value is NaN or infinite.</exception>
    public static Percentiles Of(IEnumerable<double> values)
    {
        ArgumentNullException.ThrowIfNull(values);
        double[] sorted = values.ToArray();
        foreach (double value in sorted)
        {
            if (!double.IsFinite(value))
            {
                throw new ArgumentOutOfRangeException(nameof(values), value, "A percentile of values that are not finite has no meaning.");
            }
        }

        if (sorted.Length == 0)
        {
            return default;
        }

        Array.Sort(sorted);
        return new Percentiles(Quantile(sorted, 0.5), Quantile(sorted, 0.99), sorted[^1]);
    }

    private static double Quantile(double[] sorted, double tau) =>
        SortedArrayStatistics.QuantileCustom(sorted, tau, QuantileDefinition.R7);
}
