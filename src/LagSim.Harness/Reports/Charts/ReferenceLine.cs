using System;

namespace LagSim.Harness.Reports.Charts;

/// <summary>A horizontal line to compare a series with, such as a published figure or a bound. Immutable.</summary>
public sealed class ReferenceLine
{
    /// <summary>Creates a reference line. The y axis always includes it.</summary>
    /// <param name="y">The value in the unit of the y axis; finite.</param>
    /// <param name="label">The label, for example <c>thesis RMS 0.029 m</c>; written right of the plot.</param>
    /// <exception cref="ArgumentException"><paramref name="y"/> is not finite or <paramref name="label"/> is empty.</exception>
    public ReferenceLine(double y, string label)
    {
        ArgumentException.ThrowIfNullOrEmpty(label);
        if (!double.IsFinite(y))
        {
            throw new ArgumentOutOfRangeException(nameof(y), y, $"Reference line '{label}' has no finite value.");
        }

        Y = y;
        Label = label;
    }

    /// <summary>The value on the y axis.</summary>
    public double Y { get; }

    /// <summary>The label.</summary>
    public string Label { get; }
}
