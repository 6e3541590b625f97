using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;
using System.Xml.Linq;
using LagSim.Harness.Reports.Charts;
using Xunit;

namespace LagSim.Tests.Charts;

public sealed class LineChartTests
{
    private static readonly XNamespace Svg = "http://www.w3.org/2000/svg";

    [Fact]
    public void ToSvg_TwoPanels_IsWellFormedAndNamesEverySeriesAndMarker()
    {
        XElement svg = XElement.Parse(TwoPanels().ToSvg());

        List<string> texts = svg.Descendants(Svg + "text").Select(t => t.Value).ToList();
        Assert.Equal("svg", svg.Name.LocalName);
        Assert.Equal("The drop", svg.Element(Svg + "title")?.Value);
        Assert.Equal("Two peers.", svg.Element(Svg + "desc")?.Value);
        foreach (string expected in new[] { "peer A", "peer B", "error", "impact", "teleport", "height (m)", "error (m)", "time (s)" })
        {
            Assert.Contains(expected, texts);
        }

        Assert.Equal("thesis RMS 0.029 m", string.Join(' ', texts.Where(t => t is "thesis RMS 0.029 m" or "thesis RMS" or "0.029 m")));
        Assert.Contains("prefers-color-scheme: dark", svg.Element(Svg + "style")?.Value);
        Assert.Equal(3, Curves(svg).Count);
        Assert.Single(svg.Descendants(Svg + "path"), p => (string?)p.Attribute("class") == "ref");
    }

    [Theory]
    [InlineData(10_000)]
    [InlineData(1e12)]
    public void ToSvg_LabelAtTheEndOfTheAxis_LiesInThePicture(double end)
    {
        XElement svg = XElement.Parse(new LineChart("t", "", [new ChartPanel("p", "m", [new ChartSeries("s", [0.01, end], [1, 2])])]) { XScale = ChartScale.Log10 }.ToSvg());
        double width = double.Parse(svg.Attribute("width")!.Value, CultureInfo.InvariantCulture);
        XElement[] labels = [.. svg.Descendants(Svg + "text").Where(t => (string?)t.Attribute("class") == "tick mid")];
        double left = double.Parse(Regex.Match((string)labels[0].Parent!.Attribute("transform")!, "[0-9.]+").Value, CultureInfo.InvariantCulture);
        Assert.All(labels, t => Assert.InRange(left + (double)t.Attribute("x")! + (6.9 / 2 * t.Value.Length), 0, width - 5));
    }

    [Theory]
    [InlineData(PointShape.Disc, true)]
    [InlineData(PointShape.OpenSquare, false)]
    public void ToSvg_SeriesWithAShape_HasOneForEachPointAndOneInTheLegend(PointShape shape, bool isSolid)
    {
        XElement[] marks = Marks(shape);
        Assert.Equal(4, marks.Sum(p => Regex.Count((string)p.Attribute("d")!, "M")));
        Assert.All(marks, p => Assert.Equal(isSolid, ((string)p.Attribute("class")!).EndsWith(" solid", StringComparison.Ordinal)));
        Assert.Empty(Marks(null));

        static XElement[] Marks(PointShape? shape) => [.. XElement.Parse(
            new LineChart("t", "", [new ChartPanel("p", "m", [new ChartSeries("s", [1, 2, 3], [1, 2, 1]) { Shape = shape }])]).ToSvg())
            .Descendants(Svg + "path").Where(p => ((string)p.Attribute("class")!).StartsWith("point ", StringComparison.Ordinal))];
    }

    [Fact]
    public void ToSvg_DashedCurvesThatCoincide_FillEachOthersGaps()
    {
        ChartSeries[] series = [.. Enumerable.Range(0, 3).Select(n => new ChartSeries($"s{n}", [0, 1], [0, 1], SeriesStyle.Dashed))];
        string[] classes = [.. XElement.Parse(Chart(series).ToSvg()).Descendants(Svg + "path")
            .Where(p => ((string)p.Attribute("class")!).Contains("dashed", StringComparison.Ordinal) && !((string)p.Attribute("d")!).EndsWith("h24", StringComparison.Ordinal))
            .Select(p => (string)p.Attribute("class")!)];
        Assert.Equal([false, true, false], classes.Select(c => c.EndsWith(" gaps", StringComparison.Ordinal)));
    }

    [Fact]
    public void ToSvg_TextWithMarkup_IsEscapedAndComesBackWhole()
    {
        const string Nasty = "a<b & \"c\" 'd' \u0001 ]]> \ud83d\ude00 \ud800";
        ChartPanel panel = new(Nasty, Nasty, [new ChartSeries(Nasty, [0, 1], [1, 2])])
        {
            Markers = [new ChartMarker(0.5, Nasty), new ChartMarker(0.5, Nasty, MarkerKind.Tick)],
            ReferenceLines = [new ReferenceLine(1.5, "<&\"")],
        };

        string text = new LineChart(Nasty, Nasty, [panel]) { XLabel = Nasty }.ToSvg();

        XElement svg = XElement.Parse(text);
        string shown = Nasty.Replace('\u0001', '\ufffd').Replace("\ud800", "\ufffd", StringComparison.Ordinal);
        Assert.Equal(shown, svg.Element(Svg + "title")?.Value);
        Assert.Equal(shown, (string?)svg.Attribute("aria-label"));
        Assert.True(svg.Descendants(Svg + "text").Count(t => t.Value == shown) >= 6);
        Assert.Contains(svg.Descendants(Svg + "text"), t => t.Value == "<&\"");
        Assert.DoesNotContain("a<b", text);
    }

    [Fact]
    public void ToSvg_LongSeriesWithOnePeak_DrawsThePeakInFewPoints()
    {
        double[] x = Enumerable.Range(0, 200_000).Select(i => i * 1e-3).ToArray();
        double[] y = new double[x.Length];
        y[123_456] = 100.0;

        XElement svg = XElement.Parse(Chart(new ChartSeries("s", x, y)).ToSvg());

        string curve = Assert.Single(Curves(svg));
        Assert.InRange(Numbers(curve).Count / 2, 100, 2100);
        Assert.Equal(0.0, Numbers(curve).Where((_, i) => i % 2 == 1).Min(), 0.01); // the peak touches the top, y = 0
    }

    [Fact]
    public void ToSvg_NaN_LiftsThePenAndKeepsALonePointVisible()
    {
        double nan = double.NaN;

        XElement svg = XElement.Parse(Chart(new ChartSeries("s", [0, 1, 2, 3, 4, 5, 6], [1, 2, nan, 3, nan, 1, 2])).ToSvg());

        string curve = Assert.Single(Curves(svg));
        Assert.Equal(3, curve.Count(c => c == 'M'));
        Assert.Single(Regex.Matches(curve, "h0"));
        Assert.DoesNotContain("NaN", curve);
    }

    [Theory]
    [InlineData(SeriesStyle.Line, "^M[^MHV]*L[^MHV]*L[^MHV]*$")]
    [InlineData(SeriesStyle.Dashed, "^M[^MHV]*L[^MHV]*L[^MHV]*$")]
    [InlineData(SeriesStyle.Step, "^M[^MLHV]*H[^V]*V[^H]*H[^V]*V[^H]*$")]
    [InlineData(SeriesStyle.Points, "^(M[^MLHV]*h0){3}$")]
    public void ToSvg_EachStyle_DrawsItsShape(SeriesStyle style, string pattern)
    {
        XElement svg = XElement.Parse(Chart(new ChartSeries("s", [0, 1, 2], [1, 2, 0], style)).ToSvg());

        Assert.Matches(pattern, Assert.Single(Curves(svg)));
    }

    [Fact]
    public void ToSvg_LogWithZeros_DrawsThemOnTheLineLabelledZero()
    {
        ChartPanel panel = new("e", "error (m)", [new ChartSeries("s", [0, 1, 2], [0.0, 1.0, 0.0])]) { Scale = ChartScale.Log10 };

        XElement svg = XElement.Parse(new LineChart("t", "", [panel]).ToSvg());

        List<double> curve = Numbers(Assert.Single(Curves(svg)));
        Assert.Equal(curve[1], curve[5]);
        Assert.True(curve[1] > curve[3] && curve[1] < panel.PlotHeight, "zero is below one, inside the frame");
        Assert.Contains(svg.Descendants(Svg + "text"), t => t.Value == "0" && Math.Abs((double)t.Attribute("y")! - curve[1]) < 5);
    }

    [Fact]
    public void ToSvg_CultureWithDecimalComma_GivesTheSameBytes()
    {
        string expected = TwoPanels().ToSvg();
        CultureInfo before = CultureInfo.CurrentCulture;
        try
        {
            CultureInfo.CurrentCulture = GermanNumbers();
            Assert.Equal("1,5", 1.5.ToString(CultureInfo.CurrentCulture)); // else the test proves nothing
            Assert.Equal(expected, TwoPanels().ToSvg());
        }
        finally
        {
            CultureInfo.CurrentCulture = before;
        }
    }

    [Theory]
    [InlineData(10, 10.5, "first")]
    [InlineData(29, 29.5, "second")] // at the right edge labels stand to the left of their lines
    public void ToSvg_LabelsThatCollide_AreNotCrossedByALine(double first, double second, string raised)
    {
        ChartPanel panel = new("h", "height (m)", [new ChartSeries("s", [0, 30], [0, 1])])
        {
            Markers = [new ChartMarker(first, "the first event"), new ChartMarker(second, "the second event")],
        };

        XElement svg = XElement.Parse(new LineChart("t", "", [panel]).ToSvg());

        XElement[] labels = svg.Descendants(Svg + "text").Where(t => t.Value.EndsWith("event", StringComparison.Ordinal)).ToArray();
        Assert.Equal(2, labels.Length);
        Assert.Contains(raised, labels.MinBy(t => (double)t.Attribute("y")!)!.Value, StringComparison.Ordinal);
    }

    [Fact]
    public void ToSvg_ManyImpactsAtOnePlace_AreDrawnOnce()
    {
        ChartPanel panel = new("h", "height (m)", [new ChartSeries("s", [0, 30], [0, 1])])
        {
            Markers = Enumerable.Range(0, 5000).Select(i => new ChartMarker(10 + (i * 1e-9), "impact", MarkerKind.Tick)).ToList(),
        };

        XElement svg = XElement.Parse(new LineChart("t", "", [panel]).ToSvg());

        Assert.Equal(2, svg.Descendants(Svg + "path").Count(p => (string?)p.Attribute("class") == "impact")); // one, and the legend's
    }

    [Fact]
    public void Constructors_BadInput_ThrowArgumentExceptionThatNamesIt()
    {
        ChartSeries series = new("s", [0], [-1]);
        ArgumentException lengths = Assert.Throws<ArgumentException>(() => new ChartSeries("heights", [1, 2], [1]));
        Assert.Contains("'heights' has 2 x values but 1 y values", lengths.Message);
        Assert.Throws<ArgumentException>(() => new ChartSeries("s", [double.NaN], [1]));
        Assert.Throws<ArgumentException>(() => new ChartSeries("s", [0], [double.PositiveInfinity]));
        Assert.Throws<ArgumentException>(() => new ChartPanel("p", "m", []));
        Assert.Throws<ArgumentException>(() => new ChartPanel("p", "m", [new ChartSeries("s", [], [])]));
        Assert.Throws<ArgumentException>(() => new LineChart("t", "", []));
        Assert.Throws<ArgumentException>(() => new LineChart("t", "", [new ChartPanel("p", "m", [series]) { Scale = ChartScale.Log10 }]));
        Assert.Throws<ArgumentException>(() => new LineChart("t", "", [new ChartPanel("p", "m", [series]) { PlotHeight = double.NaN }]));
        Assert.Throws<ArgumentException>(() => new LineChart(
            "t", "", [new ChartPanel("p", "m", [series]) { HasLegendAtRight = true, ReferenceLines = [new ReferenceLine(1, "r")] }]));
        Assert.Throws<ArgumentOutOfRangeException>(() => new ShadedBand(double.NaN, "b"));
    }

    private static CultureInfo GermanNumbers()
    {
        // Named cultures are not to be had under InvariantGlobalization; what matters of de-DE are its separators.
        CultureInfo culture = (CultureInfo)CultureInfo.InvariantCulture.Clone();
        culture.NumberFormat.NumberDecimalSeparator = ",";
        culture.NumberFormat.NumberGroupSeparator = ".";
        culture.NumberFormat.NegativeSign = "\u2212";
        return culture;
    }

    private static LineChart Chart(params ChartSeries[] series) => new("t", "", [new ChartPanel("p", "height (m)", series)]);

    private static LineChart TwoPanels()
    {
        double[] t = Enumerable.Range(0, 301).Select(i => i * 0.1).ToArray();
        double[] height = t.Select(s => 10.5 * Math.Abs(Math.Cos(s))).ToArray();
        return new LineChart("The drop", "Two peers.",
        [
            new ChartPanel("Height", "height (m)", [new ChartSeries("peer A", t, height), new ChartSeries("peer B", t, height, SeriesStyle.Dashed)])
            {
                Markers = [new ChartMarker(12.25, "teleport"), new ChartMarker(1.57, "impact", MarkerKind.Tick)],
            },
            new ChartPanel("Error", "error (m)", [new ChartSeries("error", t, t.Select(s => s * 1e-7).ToArray())])
            {
                Scale = ChartScale.Log10,
                ReferenceLines = [new ReferenceLine(0.029, "thesis RMS 0.029 m")],
            },
        ]);
    }

    /// <summary>The data of the curves; the legend's samples, which end in a fixed stroke, are not among them.</summary>
    private static List<string> Curves(XElement svg) => svg.Descendants(Svg + "path")
        .Where(p => ((string?)p.Attribute("class"))?.StartsWith("line ", StringComparison.Ordinal) == true)
        .Select(p => (string)p.Attribute("d")!)
        .Where(d => !d.EndsWith("h24", StringComparison.Ordinal) && !d.EndsWith("m4 0h0m8 0h0m8 0h0", StringComparison.Ordinal))
        .ToList();

    private static List<double> Numbers(string path) => Regex.Matches(path, @"-?\d+(\.\d+)?")
        .Select(m => double.Parse(m.Value, CultureInfo.InvariantCulture)).ToList();
}
