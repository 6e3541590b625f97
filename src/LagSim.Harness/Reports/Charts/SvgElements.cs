using System.Collections.Generic;
using System.Globalization;
using System.Text;
using System.Xml;

namespace LagSim.Harness.Reports.Charts;

/// <summary>The SVG elements of a chart.</summary>
internal static class SvgElements
{
    internal const string Namespace = "http://www.w3.org/2000/svg";

    /// <summary>Formats pixels to a hundredth, independent of the culture.</summary>
    internal static string Pixels(double value) => value.ToString("0.##", CultureInfo.InvariantCulture);

    internal static void Start(this XmlWriter svg, string name, string? cssClass = null)
    {
        svg.WriteStartElement(name, Namespace);
        if (cssClass is not null)
        {
            svg.WriteAttributeString("class", cssClass);
        }
    }

    internal static void StartGroup(this XmlWriter svg, double x, double y, string? cssClass = null)
    {
        svg.Start("g", cssClass);
        svg.WriteAttributeString("transform", $"translate({Pixels(x)} {Pixels(y)})");
    }

    internal static void Path(this XmlWriter svg, string data, string cssClass, string? tooltip = null)
    {
        svg.Start("path", cssClass);
        svg.WriteAttributeString("d", data);
        if (tooltip is not null)
        {
            svg.WriteElementString("title", Namespace, MarkupText.Clean(tooltip));
        }

        svg.WriteEndElement();
    }

    internal static void HorizontalLine(this XmlWriter svg, double x, double y, double width, string cssClass) =>
        svg.Path($"M{Pixels(x)} {Pixels(y)}h{Pixels(width)}", cssClass);

    internal static void Text(this XmlWriter svg, double x, double y, string text, string cssClass, string? transform = null)
    {
        svg.Start("text", cssClass);
        svg.WriteAttributeString("x", Pixels(x));
        svg.WriteAttributeString("y", Pixels(y));
        if (transform is not null)
        {
            svg.WriteAttributeString("transform", transform);
        }

        svg.WriteString(MarkupText.Clean(text));
        svg.WriteEndElement();
    }

    /// <summary>Estimates the width of a text, rather too large than too small, as fonts differ.</summary>
    internal static double TextWidth(string text) => 6.9 * text.Length;

    /// <summary>Breaks a text between words into lines of a limited length; a longer word has its own line.</summary>
    internal static string[] Wrap(string text, int columns)
    {
        List<string> lines = [];
        foreach (string word in text.Split(' ', System.StringSplitOptions.RemoveEmptyEntries))
        {
            if (lines.Count > 0 && lines[^1].Length + 1 + word.Length <= columns)
            {
                lines[^1] += " " + word;
            }
            else
            {
                lines.Add(word);
            }
        }

        return lines.Count == 0 ? [text] : [.. lines];
    }

    /// <summary>Returns the path data of a marker around a position: strokes that start where the one before ended.</summary>
    internal static string Mark(double x, double y, PointShape shape) => $"M{Pixels(x)} {Pixels(y)}" + shape switch
    {
        PointShape.Disc => "m-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z",
        PointShape.Square => "m-4 -4h8v8h-8z",
        PointShape.Diamond => "m0 -5.5l5.5 5.5l-5.5 5.5l-5.5 -5.5z",
        PointShape.Triangle => "m0 -5.5l5 9h-10z",
        PointShape.TriangleDown => "m0 5.5l5 -9h-10z",
        PointShape.Plus => "m-6.5 0h13m-6.5 -6.5v13",
        PointShape.OpenSquare => "m-5 -5h10v10h-10z",
        PointShape.Cross => "m-4.5 -4.5l9 9m0 -9l-9 9",
        PointShape.OpenTriangle => "m0 -7l6.5 11.5h-13z",
        PointShape.OpenDiamond => "m0 -7l7 7l-7 7l-7 -7z",
        PointShape.OpenTriangleDown => "m0 7l6.5 -11.5h-13z",
        PointShape.Circle => "m-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0z",
        _ => throw new System.ArgumentOutOfRangeException(nameof(shape), shape, "There is no such shape."),
    };

    /// <summary>Whether a marker is filled.</summary>
    internal static bool IsSolid(PointShape shape) => shape <= PointShape.TriangleDown;

    /// <summary>
    /// Returns the path data of a curve. y grows downwards from <paramref name="y"/>'s upper end. A NaN lifts the pen. A point between two
    /// of them is a dot, or nothing where points have markers.
    /// </summary>
    internal static string Curve(IReadOnlyList<(double X, double Y)> points, Axis x, Axis y, SeriesStyle style, bool hasLonePoints = true)
    {
        StringBuilder data = new();
        bool pen = false;
        for (int i = 0; i < points.Count; i++)
        {
            (double px, double py) = points[i];
            if (double.IsNaN(py))
            {
                pen = false;
                continue;
            }

            string atX = Pixels(x.Map(px)), atY = Pixels(y.Length - y.Map(py));
            bool alone = !pen && (i + 1 == points.Count || double.IsNaN(points[i + 1].Y));
            if (style == SeriesStyle.Points || (alone && hasLonePoints))
            {
                data.Append(CultureInfo.InvariantCulture, $"M{atX} {atY}h0"); // a round cap makes it a dot
            }
            else if (alone)
            {
                continue; // its mark shows it
            }
            else if (!pen)
            {
                data.Append(CultureInfo.InvariantCulture, $"M{atX} {atY}");
            }
            else if (style == SeriesStyle.Step)
            {
                data.Append(CultureInfo.InvariantCulture, $"H{atX}V{atY}");
            }
            else
            {
                data.Append(CultureInfo.InvariantCulture, $"L{atX} {atY}");
            }

            pen = true;
        }

        return data.ToString();
    }
}
