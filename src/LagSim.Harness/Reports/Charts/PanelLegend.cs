using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Reports.Charts;

/// <summary>
/// The legend of a panel and its layout: in rows beside and below the panel's title, or in a column right of the plot.
/// </summary>
/// <param name="Entries">The entries in the order of the series; y is that of the first line of text, below the legend's origin.</param>
/// <param name="Rows">The number of rows of title and legend above the plot.</param>
internal sealed record PanelLegend(IReadOnlyList<PanelLegend.Entry> Entries, int Rows)
{
    internal const double RowHeight = 18.0;
    internal const double SwatchWidth = 30.0;
    internal const double LineHeight = 15.0;
    private const double Gap = 14.0;
    private const double EntryGap = 9.0;
    private const int Columns = 26;

    /// <summary>One entry: its texts, and its series or marker; with neither it is a band.</summary>
    internal readonly record struct Entry(double X, double Y, IReadOnlyList<string> Lines, ChartSeries? Series, ChartMarker? Marker, int Slot);

    /// <summary>The space right of the plot that a legend there needs.</summary>
    internal static double WidthAtRight(ChartPanel panel) => Gap + SwatchWidth + EntriesOf(panel).SelectMany(LinesAtRight).Max(SvgElements.TextWidth);

    /// <summary>Lays out a column whose origin is the upper left corner of a plot of a given width.</summary>
    internal static PanelLegend AtRight(ChartPanel panel, double width)
    {
        List<Entry> entries = [];
        double y = 10.0;
        foreach (Entry entry in EntriesOf(panel))
        {
            string[] lines = LinesAtRight(entry);
            entries.Add(entry with { X = width + Gap, Y = y, Lines = lines });
            y += (LineHeight * lines.Length) + EntryGap;
        }

        return new PanelLegend(entries, 1);
    }

    /// <summary>Lays out rows of a given width, the first of which begins with the panel's title.</summary>
    internal static PanelLegend Above(ChartPanel panel, double width)
    {
        List<Entry> entries = [];
        double at = (SvgElements.TextWidth(panel.Title) * 1.12) + 22.0; // the title is larger and bold
        int rows = 1;
        foreach (Entry entry in EntriesOf(panel))
        {
            string text = string.Join(", ", entry.Lines);
            double wide = SwatchWidth + SvgElements.TextWidth(text);
            if (at > 0.0 && at + wide > width)
            {
                (at, rows) = (0.0, rows + 1);
            }

            entries.Add(entry with { X = at, Y = (rows - 1) * RowHeight, Lines = [text] });
            at += wide + Gap;
        }

        return new PanelLegend(entries, rows);
    }

    private static IEnumerable<Entry> EntriesOf(ChartPanel panel) => panel.Series
        .Select((series, i) => new Entry(0, 0, series.Note.Length > 0 ? [series.Name, series.Note] : [series.Name], series, null, series.Colour ?? i))
        .Concat(panel.Markers.Where(m => m.Kind == MarkerKind.Tick).DistinctBy(m => (m.Label, m.Colour))
            .Select(m => new Entry(0, 0, [m.Label], null, m, m.Colour ?? 0)))
        .Concat(panel.Band is null ? [] : [new Entry(0, 0, [panel.Band.Label], null, null, 0)]);

    private static string[] LinesAtRight(Entry entry) => [.. entry.Lines.SelectMany(line => SvgElements.Wrap(line, Columns))];
}
