using System.Collections.Generic;
using System.Globalization;
using System.Text;
using System.Xml;

namespace LagSim.Harness.Charts;

/// <summary>The few SVG elements a chart is made of.</summary>
internal static class SvgElements
{
    internal const string Namespace = "http://www.w3.org/2000/svg";

    /// <summary>Pixels to a hundredth, independent of the culture.</summary>
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

    /// <summary>The width a text will about take; rather too much than too little, as fonts differ.</summary>
    internal static double TextWidth(string text) => 6.9 * text.Length;

    /// <summary>The path data of a curve. y grows downwards from <paramref name="y"/>'s upper end; a NaN lifts the pen.</summary>
    internal static string Curve(IReadOnlyList<(double X, double Y)> points, Axis x, Axis y, SeriesStyle style)
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
            if (style == SeriesStyle.Points || alone)
            {
                data.Append(CultureInfo.InvariantCulture, $"M{atX} {atY}h0"); // a round cap makes it a dot
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
