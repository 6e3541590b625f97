using System.Collections.Generic;

namespace LagSim.Harness.Charts;

/// <summary>Maps values to pixels and knows its ticks. Pixels run from 0 (lowest value) to <see cref="Length"/>.</summary>
internal abstract class Axis
{
    protected Axis(double length) => Length = length;

    /// <summary>The length in pixels.</summary>
    public double Length { get; }

    /// <summary>The grid lines from low to high.</summary>
    public abstract IReadOnlyList<AxisTick> Ticks { get; }

    /// <summary>The pixel of a value, counted from the low end.</summary>
    public abstract double Map(double value);

    /// <summary>An axis of that scale which shows all values of the range.</summary>
    /// <param name="scale">Linear or logarithmic.</param>
    /// <param name="range">The values to show.</param>
    /// <param name="length">Pixels.</param>
    /// <param name="pixelsPerTick">The least comfortable distance between labels.</param>
    /// <param name="roundOut">Whether a linear axis ends on ticks (y) or follows its data closely (x).</param>
    /// <param name="logFloor">The lowest value a log axis tells from zero, or null for its own choice.</param>
    public static Axis Fit(ChartScale scale, ValueRange range, double length, double pixelsPerTick, bool roundOut, double? logFloor = null) =>
        scale == ChartScale.Log10
            ? new LogAxis(range, length, pixelsPerTick, logFloor)
            : new LinearAxis(range, length, pixelsPerTick, roundOut);
}
