using System;
using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Reports.Charts;

/// <summary>One plot of a <see cref="LineChart"/>, with its own y axis over the shared x axis.</summary>
public sealed class ChartPanel
{
    /// <summary>Creates a panel of series.</summary>
    /// <param name="title">The title.</param>
    /// <param name="yLabel">The label of the y axis, with its unit: <c>height (m)</c>.</param>
    /// <param name="series">At least one series with at least one point.</param>
    /// <exception cref="ArgumentException">A text is empty, or there is no point to draw.</exception>
    public ChartPanel(string title, string yLabel, IReadOnlyList<ChartSeries> series)
    {
        ArgumentException.ThrowIfNullOrEmpty(title);
        ArgumentException.ThrowIfNullOrEmpty(yLabel);
        ArgumentNullException.ThrowIfNull(series);
        if (!series.Any(s => s.X.Length > 0))
        {
            throw new ArgumentException($"Panel '{title}' is empty: it needs a series with at least one point.", nameof(series));
        }

        Title = title;
        YLabel = yLabel;
        Series = series;
    }

    /// <summary>The title.</summary>
    public string Title { get; }

    /// <summary>The label of the y axis, with its unit.</summary>
    public string YLabel { get; }

    /// <summary>The curves, drawn in this order: later ones lie on top.</summary>
    public IReadOnlyList<ChartSeries> Series { get; }

    /// <summary>The scale of the y axis.</summary>
    public ChartScale Scale { get; init; }

    /// <summary>
    /// On a log scale, the value below which everything is drawn on the lowest line; above zero. By default the lowest decade that has a
    /// value, but at most 18 decades below the highest.
    /// </summary>
    public double? LogFloor { get; init; }

    /// <summary>The marked instants.</summary>
    public IReadOnlyList<ChartMarker> Markers { get; init; } = [];

    /// <summary>The horizontal reference lines.</summary>
    public IReadOnlyList<ReferenceLine> ReferenceLines { get; init; } = [];

    /// <summary>A shaded part at the bottom; null for none.</summary>
    public ShadedBand? Band { get; init; }

    /// <summary>
    /// Whether the legend is right of the plot, one entry below the other, instead of above it. Reference lines have no room for labels
    /// then.
    /// </summary>
    public bool HasLegendAtRight { get; init; }

    /// <summary>Additional values that the y axis must include, so that several panels can have one scale.</summary>
    public IReadOnlyList<double> Reaches { get; init; } = [];

    /// <summary>The height of the plot itself in pixels, without title, legend and axis: 80 to 2000.</summary>
    public double PlotHeight { get; init; } = 200;

    /// <summary>Validates properties that depend on each other.</summary>
    internal void Check()
    {
        if (!(PlotHeight >= 80 && PlotHeight <= 2000))
        {
            throw new ArgumentException(FormattableString.Invariant($"Panel '{Title}': a plot height of {PlotHeight} is not within 80 to 2000."));
        }

        if (HasLegendAtRight && ReferenceLines.Count > 0)
        {
            throw new ArgumentException($"Panel '{Title}': the legend and the labels of reference lines cannot both stand right of the plot.");
        }

        if (LogFloor is { } floor && !(double.IsFinite(floor) && floor > 0.0))
        {
            throw new ArgumentException(FormattableString.Invariant($"Panel '{Title}': a log floor of {floor} is not above zero."));
        }

        if (Scale == ChartScale.Log10)
        {
            foreach ((string name, double value) in Series.SelectMany(s => s.Y.Select(y => (s.Name, y)))
                         .Concat(ReferenceLines.Select(r => (r.Label, r.Y))).Concat(Band is null ? [] : [(Band.Label, Band.UpTo)]).Concat(Reaches.Select(y => ("reaches", y))))
            {
                if (value < 0.0)
                {
                    throw new ArgumentException(
                        FormattableString.Invariant($"Panel '{Title}': '{name}' has the value {value:R}, which a log scale cannot show."));
                }
            }
        }
    }
}
