using System;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using System.Xml;
using System.Xml.Linq;
using LagSim.Harness.Reports;
using LagSim.Harness.Reports.Charts;
using Xunit;

namespace LagSim.Tests.Reports;

public sealed class HtmlReportTests
{
    private const string Nasty = "<script>alert(\"x\" & 'y')</script>";

    [Fact]
    public void Write_AllBlocks_AreThereInOrder()
    {
        XElement html = Parse(Write(Report("T")));

        string[] order = html.Descendants("main").Single().Elements().Select(e => e.Name.LocalName).ToArray();
        Assert.Equal(["h1", "p", "h2", "p", "div", "figure", "figure"], order);
        Assert.Equal(2, html.Descendants().Count(e => e.Name.LocalName == "svg"));
        Assert.Contains("lagsim 0.1.0, seed 7, scene 0123456789abcdef", html.Descendants("footer").Single().Value);
    }

    [Fact]
    public void Write_TextWithMarkup_IsEscaped()
    {
        string text = Write(Report(Nasty));

        Assert.DoesNotContain("<script", text);
        XElement html = Parse(text);
        Assert.Equal(Nasty, html.Descendants("title").First().Value);
        foreach (string element in new[] { "h1", "h2", "caption", "figcaption" })
        {
            Assert.Equal(Nasty, html.Descendants(element).First().Value);
        }

        Assert.Contains(html.Descendants("td"), cell => cell.Value == Nasty);
    }

    [Fact]
    public void Write_Page_LoadsNothingFromElsewhere()
    {
        string text = Write(Report("T")).Replace("xmlns=\"http://www.w3.org/2000/svg\"", "", StringComparison.Ordinal);

        Assert.DoesNotMatch("https?:|src=|href=|@import|url\\(", text);
        Assert.Contains("default-src 'none'", text);
    }

    /// <summary>HTML knows the short form of an end tag only for void elements and inside SVG.</summary>
    [Fact]
    public void Write_EmptyTexts_StillHaveEndTags()
    {
        HtmlReport report = new HtmlReport("T", "", new ReportFooter("lagsim", "1", 1, null))
            .AddTable(new ReportTable("", ["a"], [[""]])).AddTable(new ReportTable("", ["a"], []));

        string text = Write(report);

        Assert.All(Regex.Matches(text, "<(\\w+)[^>]*/>").Select(m => m.Groups[1].Value), name => Assert.Equal("meta", name));
        Assert.StartsWith("<!DOCTYPE html", text);
        Assert.DoesNotContain("scene", Parse(text).Descendants("footer").Single().Value);
    }

    [Fact]
    public void Write_StyleSheets_HoldNothingThatHtmlWouldReadOtherwise()
    {
        // A browser takes the text of a style element as it stands: an entity in it would break the sheet.
        foreach (Match style in Regex.Matches(Write(Report("T")), "<style[^>]*>(.*?)</style>", RegexOptions.Singleline))
        {
            Assert.DoesNotContain("&", style.Groups[1].Value);
        }
    }

    [Fact]
    public void AddTable_NumbersAlone_AreSetFlushRight()
    {
        ReportTable table = new("c", ["name", "rms_m"], [["a", "1.5e-3"], ["b", "\u2013"]]);

        XElement html = Parse(Write(new HtmlReport("T", "i", new ReportFooter("lagsim", "1", 1, null)).AddTable(table)));

        Assert.All(html.Descendants("tr"), row => Assert.Equal([null, "n"], row.Elements().Select(c => (string?)c.Attribute("class"))));
    }

    [Fact]
    public void ReportTable_RaggedRows_Throws()
    {
        Assert.Throws<ArgumentException>(() => new ReportTable("c", ["a", "b"], [["1"]]));
        Assert.Throws<ArgumentException>(() => new ReportTable("c", [], []));
    }

    private static HtmlReport Report(string text)
    {
        LineChart chart = new(text, text, [new ChartPanel("p", "m", [new ChartSeries("s", [0, 1], [1, 2])])]);
        return new HtmlReport(text, text, new ReportFooter("lagsim", "0.1.0", 7, "0123456789abcdef"))
            .AddHeading(text).AddParagraph(text).AddTable(new ReportTable(text, [text, "b"], [[text, "2"]])).AddChart(chart, text).AddChart(chart);
    }

    private static string Write(HtmlReport report)
    {
        using StringWriter text = new();
        report.Write(text);
        return text.ToString();
    }

    private static XElement Parse(string text)
    {
        using XmlReader reader = XmlReader.Create(new StringReader(text), new XmlReaderSettings { DtdProcessing = DtdProcessing.Ignore });
        return XElement.Load(reader);
    }
}
