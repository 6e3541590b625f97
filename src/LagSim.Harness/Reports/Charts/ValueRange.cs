using System;
using System.Collections.Generic;

namespace LagSim.Harness.Reports.Charts;

/// <summary>The extent of an axis's values, and of the positive ones. NaN does not count.</summary>
internal sealed class ValueRange
{
    public double Min { get; private set; } = double.PositiveInfinity;

    public double Max { get; private set; } = double.NegativeInfinity;

    public double MinPositive { get; private set; } = double.PositiveInfinity;

    public bool IsEmpty => Min > Max;

    public void Include(double value)
    {
        if (double.IsNaN(value))
        {
            return;
        }

        Min = Math.Min(Min, value);
        Max = Math.Max(Max, value);
        if (value > 0.0)
        {
            MinPositive = Math.Min(MinPositive, value);
        }
    }

    public void Include(IEnumerable<double> values)
    {
        foreach (double value in values)
        {
            Include(value);
        }
    }
}
