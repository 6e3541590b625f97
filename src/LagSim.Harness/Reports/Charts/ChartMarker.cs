using System;

namespace LagSim.Harness.Reports.Charts;

/// <summary>A marked instant on the x axis. Immutable.</summary>
public sealed class ChartMarker
{
    /// <summary>Creates a marker.</summary>
    /// <param name="x">The position in the unit of the x axis (most often seconds); finite.</param>
    /// <param name="label">The label, for example <c>teleport</c>.</param>
    /// <param name="kind">A line across the panel or a small triangle.</param>
    /// <param name="colour">A palette slot, to match a series; null for the neutral colour of annotations.</param>
    /// <exception cref="ArgumentException"><paramref name="x"/> is not finite, <paramref name="label"/> is empty or the slot
    /// negative.</exception>
    public ChartMarker(double x, string label, MarkerKind kind = MarkerKind.Line, int? colour = null)
    {
        ArgumentException.ThrowIfNullOrEmpty(label);
        if (!double.IsFinite(x))
        {
            throw new ArgumentOutOfRangeException(nameof(x), x, $"Marker '{label}' stands at no finite place.");
        }

        ArgumentOutOfRangeException.ThrowIfNegative(colour ?? 0, nameof(colour));
        X = x;
        Label = label;
        Kind = kind;
        Colour = colour;
    }

    /// <summary>The position on the x axis.</summary>
    public double X { get; }

    /// <summary>The label.</summary>
    public string Label { get; }

    /// <summary>The kind of marker.</summary>
    public MarkerKind Kind { get; }

    /// <summary>The palette slot, or null for the neutral colour.</summary>
    public int? Colour { get; }
}
