using System;
using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Experiments.Metrics;

/// <summary>The arithmetic mean and the 99th percentile of a list of values, such as counts.</summary>
/// <param name="Mean">The mean; 0 without a value.</param>
/// <param name="P99">The 99th percentile, as <see cref="Percentiles"/> has it; 0 without a value.</param>
public readonly record struct MeanAndTail(double Mean, double P99)
{
    /// <summary>Those of these values, in any order; zero where there are none.</summary>
    /// <exception cref="ArgumentNullException"><paramref name="values"/> is null.</exception>
    /// <exception cref="ArgumentOutOfRangeException">A value is NaN or infinite.</exception>
    public static MeanAndTail Of(IReadOnlyCollection<double> values)
    {
        ArgumentNullException.ThrowIfNull(values);
        return values.Count == 0 ? default : new MeanAndTail(values.Average(), Percentiles.Of(values).P99);
    }
}
