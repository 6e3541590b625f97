using System;

namespace LagSim.Harness.Reports.Charts;

/// <summary>A horizontal line to compare a series with, such as a published figure or a bound. Immutable.</summary>
public sealed class ReferenceLine
{
    /// <summary>A reference line. The y axis always reaches it.</summary>
    /// <param name="y">Its value in the unit of the y axis; finite.</param>
    /// <param name="label">What it stands for, for example <c>thesis RMS 0.029 m</c>; written right of the plot.</param>
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

    /// <summary>What the line stands for.</summary>
    public string Label { get; }
}
