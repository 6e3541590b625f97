using System.Collections.Generic;

namespace LagSim.Harness.Reports.Charts;

/// <summary>An axis that maps values to pixels and knows its ticks. Pixels run from 0 (lowest value) to <see cref="Length"/>.</summary>
internal abstract class Axis
{
    protected Axis(double length, double inset) => (Length, Inset) = (length, inset);

    /// <summary>The length in pixels.</summary>
    public double Length { get; }

    /// <summary>The pixels kept free at either end, so that a point's marker does not lie on the frame.</summary>
    public double Inset { get; }

    /// <summary>The grid lines from low to high.</summary>
    public abstract IReadOnlyList<AxisTick> Ticks { get; }

    /// <summary>Returns the pixel of a value, counted from the low end.</summary>
    public abstract double Map(double value);

    /// <summary>Creates an axis of a scale that shows all values of the range.</summary>
    /// <param name="scale">Linear or logarithmic.</param>
    /// <param name="range">The values to show.</param>
    /// <param name="length">The length in pixels.</param>
    /// <param name="pixelsPerTick">The least distance between labels, in pixels.</param>
    /// <param name="roundOut">Whether the axis ends on ticks, or on decades (y), or follows its data closely (x).</param>
    /// <param name="logFloor">The lowest value that a log axis distinguishes from zero, or null for its own choice.</param>
    /// <param name="inset">The pixels to keep free at either end.</param>
    public static Axis Fit(
        ChartScale scale, ValueRange range, double length, double pixelsPerTick, bool roundOut, double? logFloor = null, double inset = 0) =>
        scale == ChartScale.Log10
            ? new LogAxis(range, length, pixelsPerTick, roundOut, logFloor, inset)
            : new LinearAxis(range, length, pixelsPerTick, roundOut, inset);
}
