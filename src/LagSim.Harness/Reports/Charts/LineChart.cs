using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text;
using System.Xml;

namespace LagSim.Harness.Reports.Charts;

/// <summary>A chart of stacked panels over one x axis, written as a self-contained SVG for light and dark pages.</summary>
/// <remarks>
/// The same chart gives the same bytes on every system and in every culture. Long series are thinned for drawing so that every peak stays
/// visible. Not thread-safe while the arrays of its series change.
/// </remarks>
public sealed class LineChart
{
    /// <summary>The width of every chart, in pixels of its own coordinates.</summary>
    public const double Width = 960.0;

    /// <summary>The number of curves with different colours; further ones repeat colours.</summary>
    public static int Colours => ChartTheme.Colours;

    /// <summary>The pixels between markers and the frame.</summary>
    private const double PointInset = 10.0;

    private const double HeadHeight = 34.0;
    private const double PanelGap = 26.0;
    private const double FootHeight = 54.0;

    /// <summary>Creates a chart of panels, from top to bottom.</summary>
    /// <param name="title">The title, which is also the accessible name.</param>
    /// <param name="description">A description for readers who cannot see the chart.</param>
    /// <param name="panels">At least one.</param>
    /// <exception cref="ArgumentException">
    /// There is no title or panel, a panel's height or log floor is out of range, or a log scale was given a negative value.
    /// </exception>
    public LineChart(string title, string description, IReadOnlyList<ChartPanel> panels)
    {
        ArgumentException.ThrowIfNullOrEmpty(title);
        ArgumentNullException.ThrowIfNull(description);
        ArgumentNullException.ThrowIfNull(panels);
        if (panels.Count == 0)
        {
            throw new ArgumentException($"Chart '{title}' has no panel.", nameof(panels));
        }

        foreach (ChartPanel panel in panels)
        {
            panel.Check();
        }

        Title = title;
        Description = description;
        Panels = panels;
    }

    /// <summary>The title.</summary>
    public string Title { get; }

    /// <summary>The description for readers who cannot see the chart.</summary>
    public string Description { get; }

    /// <summary>The panels, from top to bottom.</summary>
    public IReadOnlyList<ChartPanel> Panels { get; }

    /// <summary>The label of the x axis, with its unit.</summary>
    public string XLabel { get; init; } = "time (s)";

    /// <summary>The scale of the x axis.</summary>
    public ChartScale XScale { get; init; }

    /// <summary>Writes the chart to a file as UTF-8 without a byte order mark.</summary>
    /// <exception cref="IOException">The file cannot be written.</exception>
    public void Save(string path)
    {
        using StreamWriter file = new(path, append: false, new UTF8Encoding(encoderShouldEmitUTF8Identifier: false));
        Write(file);
    }

    /// <summary>Writes the chart as an SVG document. The writer stays open.</summary>
    public void Write(TextWriter output)
    {
        ArgumentNullException.ThrowIfNull(output);
        using XmlWriter svg = XmlWriter.Create(output, MarkupText.Settings);
        WriteTo(svg);
    }

    /// <summary>Returns the chart as the text of an SVG document.</summary>
    public string ToSvg()
    {
        using StringWriter text = new();
        Write(text);
        return text.ToString();
    }

    /// <summary>Writes only the <c>svg</c> element, for instance into a page.</summary>
    internal void WriteTo(XmlWriter svg)
    {
        List<Axis> yAxes = Panels.Select(FitY).ToList();
        double widest = yAxes.SelectMany(axis => axis.Ticks).Max(tick => SvgElements.TextWidth(tick.Label ?? ""));
        double left = 30.0 + widest, right = Math.Max(18.0, Panels.Max(PanelLayout.WidthAtRight) + 6.0);
        Axis x = FitX(Width - left - right);
        right = Math.Max(right, x.Ticks.Max(tick => tick.Pixel + (SvgElements.TextWidth(tick.Label ?? "") / 2.0)) - x.Length + 6.0); // the last label is centred on its line
        x = FitX(Width - left - right);
        List<PanelLayout> layouts = Panels.Select((panel, i) => new PanelLayout(panel, x, yAxes[i])).ToList();
        double height = HeadHeight + layouts.Sum(l => l.HeaderHeight + l.Y.Length) + (PanelGap * (layouts.Count - 1)) + FootHeight;

        svg.Start("svg", "lagsim-chart");
        svg.WriteAttributeString("viewBox", $"0 0 {SvgElements.Pixels(Width)} {SvgElements.Pixels(height)}");
        svg.WriteAttributeString("width", SvgElements.Pixels(Width));
        svg.WriteAttributeString("height", SvgElements.Pixels(height));
        svg.WriteAttributeString("role", "img");
        svg.WriteAttributeString("aria-label", MarkupText.Clean(Title));
        svg.WriteElementString("title", SvgElements.Namespace, MarkupText.Clean(Title));
        svg.WriteElementString("desc", SvgElements.Namespace, MarkupText.Clean(Description));
        svg.WriteElementString("style", SvgElements.Namespace, ChartTheme.Css);
        svg.Path($"M0 0H{SvgElements.Pixels(Width)}V{SvgElements.Pixels(height)}H0Z", "bg");
        svg.Text(left, 22, Title, "h1");

        double at = HeadHeight;
        for (int i = 0; i < layouts.Count; i++)
        {
            at += layouts[i].HeaderHeight;
            svg.StartGroup(left, at);
            PanelPainter.Paint(svg, layouts[i], left, last: i == layouts.Count - 1, XLabel);
            svg.WriteEndElement();
            at += layouts[i].Y.Length + PanelGap;
        }

        svg.WriteEndElement();
    }

    private static Axis FitY(ChartPanel panel)
    {
        ValueRange range = new();
        range.Include(panel.Series.SelectMany(series => series.Y));
        range.Include(panel.ReferenceLines.Select(line => line.Y));
        range.Include(panel.Reaches);
        range.Include(panel.Band?.UpTo ?? double.NaN);
        return Axis.Fit(panel.Scale, range, panel.PlotHeight, pixelsPerTick: 34.0, roundOut: true, panel.LogFloor, Inset([panel]));
    }

    private Axis FitX(double length)
    {
        ValueRange range = new();
        range.Include(Panels.SelectMany(panel => panel.Series).SelectMany(series => series.X));
        range.Include(Panels.SelectMany(panel => panel.Markers).Select(marker => marker.X));
        return Axis.Fit(XScale, range, length, pixelsPerTick: 80.0, roundOut: false, inset: Inset(Panels));
    }

    private static double Inset(IEnumerable<ChartPanel> panels) =>
        panels.SelectMany(panel => panel.Series).Any(series => series.Shape is not null || series.Style == SeriesStyle.Points) ? PointInset : 0.0;
}
