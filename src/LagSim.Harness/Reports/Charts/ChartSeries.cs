using System;

namespace LagSim.Harness.Reports.Charts;

/// <summary>A named curve, with as many x as y values.</summary>
/// <remarks>The arrays are kept, not copied. Do not change them until the chart is written.</remarks>
public sealed class ChartSeries
{
    /// <summary>Creates a series.</summary>
    /// <param name="name">The name in the legend.</param>
    /// <param name="x">Positions on the x axis, in its unit (most often seconds), finite, in the order to be joined.</param>
    /// <param name="y">Values in the unit of the panel. NaN breaks the line; infinity is refused.</param>
    /// <param name="style">How the series is drawn.</param>
    /// <param name="colour">A palette slot, so that the same thing keeps its colour in every panel; null takes the series' place in the
    /// panel.</param>
    /// <exception cref="ArgumentException">
    /// The name is empty, the lengths differ, an x is not finite, a y is infinite or the slot is negative.
    /// </exception>
    public ChartSeries(string name, double[] x, double[] y, SeriesStyle style = SeriesStyle.Line, int? colour = null)
    {
        ArgumentException.ThrowIfNullOrEmpty(name);
        ArgumentNullException.ThrowIfNull(x);
        ArgumentNullException.ThrowIfNull(y);
        ArgumentOutOfRangeException.ThrowIfNegative(colour ?? 0, nameof(colour));
        if (x.Length != y.Length)
        {
            throw new ArgumentException($"Series '{name}' has {x.Length} x values but {y.Length} y values.", nameof(y));
        }

        for (int i = 0; i < x.Length; i++)
        {
            if (!double.IsFinite(x[i]))
            {
                throw new ArgumentException(FormattableString.Invariant($"Series '{name}': x[{i}] is {x[i]:R}; it must be finite."), nameof(x));
            }

            if (double.IsInfinity(y[i]))
            {
                throw new ArgumentException(
                    FormattableString.Invariant($"Series '{name}': y[{i}] is {y[i]:R}; it must be finite, or NaN for a gap."), nameof(y));
            }
        }

        Name = name;
        X = x;
        Y = y;
        Style = style;
        Colour = colour;
    }

    /// <summary>The name in the legend.</summary>
    public string Name { get; }

    /// <summary>The positions on the x axis.</summary>
    public double[] X { get; }

    /// <summary>The values; NaN is a gap.</summary>
    public double[] Y { get; }

    /// <summary>How the series is drawn.</summary>
    public SeriesStyle Style { get; }

    /// <summary>The marker of each point in addition to the line, for a series of few points; null for none.</summary>
    public PointShape? Shape { get; init; }

    /// <summary>Whether the series is emphasised.</summary>
    public bool IsEmphasised { get; init; }

    /// <summary>Text in the legend after the name; may be empty.</summary>
    public string Note { get; init; } = "";

    /// <summary>The palette slot, or null for the series' place in its panel.</summary>
    public int? Colour { get; }
}
