using System;

namespace LagSim.Harness.Reports.Charts;

/// <summary>The part of a panel below a value, shaded and named in the legend. Immutable.</summary>
public sealed class ShadedBand
{
    /// <summary>Creates a band from the bottom of the panel up to a value, which the y axis always includes.</summary>
    /// <param name="upTo">Its upper end in the unit of the y axis; finite.</param>
    /// <param name="label">The label, for example <c>rounding</c>.</param>
    /// <exception cref="ArgumentException"><paramref name="upTo"/> is not finite or <paramref name="label"/> is empty.</exception>
    public ShadedBand(double upTo, string label)
    {
        ArgumentException.ThrowIfNullOrEmpty(label);
        if (!double.IsFinite(upTo))
        {
            throw new ArgumentOutOfRangeException(nameof(upTo), upTo, $"Band '{label}' ends at no finite value.");
        }

        UpTo = upTo;
        Label = label;
    }

    /// <summary>The upper end on the y axis.</summary>
    public double UpTo { get; }

    /// <summary>The label.</summary>
    public string Label { get; }
}
