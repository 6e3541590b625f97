using System;
using System.Collections.Generic;
using System.Linq;
using System.Xml;

namespace LagSim.Harness.Reports.Charts;

/// <summary>Draws one laid-out panel. The origin is the upper left corner of its plot.</summary>
internal static class PanelPainter
{
    private const string Triangle = "l-4 7h8z"; // from its upper corner

    internal static void Paint(XmlWriter svg, PanelLayout layout, double left, bool last, string xLabel)
    {
        PaintHeader(svg, layout);
        PaintGrid(svg, layout, left, last, xLabel);
        PaintReferences(svg, layout);
        PaintMarkers(svg, layout);
        int dashed = 0;
        for (int i = 0; i < layout.Panel.Series.Count; i++)
        {
            ChartSeries series = layout.Panel.Series[i];
            int slot = series.Colour ?? i;
            List<(double X, double Y)> points = Decimation.Thin(series.X, series.Y);
            // Of two dashed curves that coincide, the dashes of one lie in the gaps of the other.
            string gaps = series.Style == SeriesStyle.Dashed && dashed++ % 2 > 0 ? " gaps" : "";
            string curve = SvgElements.Curve(points, layout.X, layout.Y, series.Style, hasLonePoints: series.Shape is null);
            if (curve.Length > 0)
            {
                svg.Path(curve, CurveClass(series, slot) + gaps);
            }

            if (series.Shape is PointShape shape)
            {
                svg.Path(string.Concat(points.Where(p => !double.IsNaN(p.Y))
                    .Select(p => SvgElements.Mark(layout.X.Map(p.X), layout.Y.Length - layout.Y.Map(p.Y), shape))), ShapeClass(shape, slot));
            }
        }
    }

    private static void PaintHeader(XmlWriter svg, PanelLayout layout)
    {
        double top = 13.0 - layout.HeaderHeight;
        svg.Text(0, top, layout.Panel.Title, "h2");
        foreach (PanelLegend.Entry entry in layout.Legend.Entries)
        {
            double y = entry.Y + (layout.Panel.HasLegendAtRight ? 0 : top);
            if (entry.Series is { } series)
            {
                string sample = series.Style == SeriesStyle.Points ? "m4 0h0m8 0h0m8 0h0" : "h24";
                svg.Path($"M{SvgElements.Pixels(entry.X)} {SvgElements.Pixels(y - 4)}{sample}", CurveClass(series, entry.Slot));
                if (series.Shape is PointShape shape)
                {
                    svg.Path(SvgElements.Mark(entry.X + 12, y - 4, shape), ShapeClass(shape, entry.Slot));
                }
            }
            else if (entry.Marker is { } marker)
            {
                svg.Path($"M{SvgElements.Pixels(entry.X + 18)} {SvgElements.Pixels(y - 8)}{Triangle}", TriangleClass(marker));
            }
            else
            {
                svg.Path($"M{SvgElements.Pixels(entry.X)} {SvgElements.Pixels(y - 9)}h24v11h-24z", "band");
            }

            for (int i = 0; i < entry.Lines.Count; i++)
            {
                svg.Text(entry.X + PanelLegend.SwatchWidth, y + (i * PanelLegend.LineHeight), entry.Lines[i], "label");
            }
        }
    }

    private static void PaintGrid(XmlWriter svg, PanelLayout layout, double left, bool last, string xLabel)
    {
        double width = layout.X.Length, height = layout.Y.Length;
        double below = layout.Panel.Markers.Any(m => m.Kind == MarkerKind.Tick) ? 6.0 : 0.0; // room for the triangles
        if (layout.Panel.Band is { } band)
        {
            double tall = layout.Y.Map(band.UpTo);
            svg.Path($"M0 {SvgElements.Pixels(height - tall)}h{SvgElements.Pixels(width)}v{SvgElements.Pixels(tall)}h{SvgElements.Pixels(-width)}z", "band", band.Label);
        }

        foreach (AxisTick tick in layout.Y.Ticks)
        {
            svg.HorizontalLine(0, height - tick.Pixel, width, tick.Label is null ? "minor" : "grid");
            if (tick.Label is not null)
            {
                svg.Text(-8, height - tick.Pixel + 4, tick.Label, "tick end");
            }
        }

        foreach (AxisTick tick in layout.X.Ticks)
        {
            svg.Path($"M{SvgElements.Pixels(tick.Pixel)} 0v{SvgElements.Pixels(height)}", tick.Label is null ? "minor" : "grid");
            if (last && tick.Label is not null)
            {
                svg.Text(tick.Pixel, height + 18 + below, tick.Label, "tick mid");
            }
        }

        svg.Path($"M0 0V{SvgElements.Pixels(height)}H{SvgElements.Pixels(width)}", "frame");
        svg.Text(0, 0, layout.Panel.YLabel, "label mid", $"translate({SvgElements.Pixels(13 - left)} {SvgElements.Pixels(height / 2)}) rotate(-90)");
        if (last)
        {
            svg.Text(width / 2, height + 38 + below, xLabel, "label mid");
        }
    }

    private static void PaintReferences(XmlWriter svg, PanelLayout layout)
    {
        foreach (ReferenceLine line in layout.Panel.ReferenceLines)
        {
            svg.HorizontalLine(0, layout.Y.Length - layout.Y.Map(line.Y), layout.X.Length, "ref");
        }

        foreach (PanelLayout.ReferenceLabel label in layout.ReferenceLabels)
        {
            double y = label.Y + 4 - (7.0 * (label.Lines.Length - 1));
            for (int i = 0; i < label.Lines.Length; i++)
            {
                svg.Text(layout.X.Length + 6, y + (14.0 * i), label.Lines[i], "note");
            }
        }
    }

    private static void PaintMarkers(XmlWriter svg, PanelLayout layout)
    {
        HashSet<(int Pixel, string Label, int? Colour)> seen = [];
        foreach (ChartMarker marker in layout.Panel.Markers)
        {
            double x = layout.X.Map(marker.X);
            string tooltip = FormattableString.Invariant($"{marker.Label}: {marker.X:R}");
            if (marker.Kind == MarkerKind.Line)
            {
                double top = layout.MarkerLabels.Where(l => l.X.Equals(x)).Select(l => l.Y - 9.0).DefaultIfEmpty(0.0).Min();
                svg.Path($"M{SvgElements.Pixels(x)} {SvgElements.Pixels(top)}V{SvgElements.Pixels(layout.Y.Length)}", "mark", tooltip);
            }
            else if (seen.Add(((int)Math.Round(x), marker.Label, marker.Colour)))
            {
                // A ball that comes to rest bounces ever more often: one triangle a pixel is enough.
                svg.Path($"M{SvgElements.Pixels(x)} {SvgElements.Pixels(layout.Y.Length + 1.5)}{Triangle}", TriangleClass(marker), tooltip);
            }
        }

        foreach (PanelLayout.MarkerLabel label in layout.MarkerLabels)
        {
            svg.Text(label.X + (label.ToTheLeft ? -5 : 5), label.Y, label.Text, label.ToTheLeft ? "note end" : "note");
        }
    }

    private static string TriangleClass(ChartMarker marker) =>
        marker.Colour is { } slot ? "impact " + ChartTheme.ColourClass(slot) : "impact";

    private static string CurveClass(ChartSeries series, int slot) => "line " + ChartTheme.ColourClass(slot) + series.Style switch
    {
        SeriesStyle.Dashed => " dashed",
        SeriesStyle.Points => " dots",
        _ => "",
    } + (series.IsEmphasised ? " strong" : "");

    private static string ShapeClass(PointShape shape, int slot) =>
        "point " + ChartTheme.ColourClass(slot) + (SvgElements.IsSolid(shape) ? " solid" : "");
}
