using System;
using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Reports.Charts;

/// <summary>
/// The layout of a panel's texts, so that none covers data or another text. Positions are pixels from the panel's plot corner.
/// </summary>
internal sealed class PanelLayout
{
    private const double MarkerRowHeight = 15.0;
    private const int MaxMarkerRows = 4;
    private const int ReferenceColumns = 24;
    private readonly List<MarkerLabel> _markerLabels = [];
    private readonly List<ReferenceLabel> _referenceLabels = [];
    private int _markerRows;

    public PanelLayout(ChartPanel panel, Axis x, Axis y)
    {
        Panel = panel;
        X = x;
        Y = y;
        Legend = panel.HasLegendAtRight ? PanelLegend.AtRight(panel, x.Length) : PanelLegend.Above(panel, x.Length);
        PlaceMarkerLabels();
        PlaceReferenceLabels();
    }

    internal readonly record struct MarkerLabel(double X, double Y, string Text, bool ToTheLeft);

    internal readonly record struct ReferenceLabel(double Y, string[] Lines);

    public ChartPanel Panel { get; }

    public Axis X { get; }

    public Axis Y { get; }

    public PanelLegend Legend { get; }

    public IReadOnlyList<MarkerLabel> MarkerLabels => _markerLabels;

    public IReadOnlyList<ReferenceLabel> ReferenceLabels => _referenceLabels;

    /// <summary>The strip above the plot that holds the labels of vertical lines.</summary>
    public double MarkerStrip => _markerRows * MarkerRowHeight;

    /// <summary>The space above the plot: title, legend, marker labels.</summary>
    public double HeaderHeight => (Legend.Rows * PanelLegend.RowHeight) + MarkerStrip + 8.0;

    /// <summary>The space right of the plot for a legend or the labels of reference lines.</summary>
    public static double WidthAtRight(ChartPanel panel) => panel.HasLegendAtRight ? PanelLegend.WidthAtRight(panel)
        : panel.ReferenceLines.Count == 0 ? 0.0
        : 8.0 + panel.ReferenceLines.SelectMany(line => SvgElements.Wrap(line.Label, ReferenceColumns)).Max(SvgElements.TextWidth);

    private void PlaceMarkerLabels()
    {
        List<(double From, double To, int Row)> taken = [];
        List<(MarkerLabel Label, int Row)> placed = [];
        // Of colliding labels, the raised one is that whose line is clear of the others: no line goes through a text.
        IEnumerable<(ChartMarker Marker, double X, double Width, bool IsLeft)> lines = Panel.Markers
            .Where(m => m.Kind == MarkerKind.Line)
            .Select(m => (Marker: m, X: X.Map(m.X), Width: SvgElements.TextWidth(m.Label) + 6.0))
            .Select(m => (m.Marker, m.X, m.Width, IsLeft: m.X + m.Width > X.Length))
            .OrderBy(m => m.IsLeft ? m.X : -m.X);
        foreach ((ChartMarker marker, double x, double width, bool left) in lines)
        {
            (double from, double to) = left ? (x - width, x) : (x, x + width);
            int row = 0;
            while (row < MaxMarkerRows && taken.Any(t => t.Row == row && from < t.To && to > t.From))
            {
                row++;
            }

            if (row == MaxMarkerRows)
            {
                continue; // too many at one position; the line's tooltip still names it
            }

            taken.Add((from, to, row));
            placed.Add((new MarkerLabel(x, 0.0, marker.Label, left), row));
            _markerRows = Math.Max(_markerRows, row + 1);
        }

        // Row 0 is next to the plot; rows above it are used only where labels would collide.
        _markerLabels.AddRange(placed.Select(p => p.Label with { Y = -5.0 - (p.Row * MarkerRowHeight) }));
    }

    private void PlaceReferenceLabels()
    {
        _referenceLabels.AddRange(Panel.ReferenceLines.OrderByDescending(line => line.Y)
            .Select(line => new ReferenceLabel(Y.Length - Y.Map(line.Y), SvgElements.Wrap(line.Label, ReferenceColumns))));

        // Labels of neighbouring lines push each other apart until all are readable.
        for (int pass = 0; pass < 50; pass++)
        {
            for (int i = 1; i < _referenceLabels.Count; i++)
            {
                (ReferenceLabel upper, ReferenceLabel lower) = (_referenceLabels[i - 1], _referenceLabels[i]);
                double overlap = upper.Y + (7.0 * (upper.Lines.Length + lower.Lines.Length)) + 3.0 - lower.Y;
                if (overlap > 0.0)
                {
                    _referenceLabels[i - 1] = upper with { Y = upper.Y - (0.5 * overlap) };
                    _referenceLabels[i] = lower with { Y = lower.Y + (0.5 * overlap) };
                }
            }
        }
    }
}
