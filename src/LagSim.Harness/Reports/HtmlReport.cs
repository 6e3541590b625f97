using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Text;
using System.Xml;
using LagSim.Harness.Reports.Charts;

namespace LagSim.Harness.Reports;

/// <summary>A self-contained web page: headings, text, tables and charts in the order they were added.</summary>
/// <remarks>
/// No script, nothing loaded from elsewhere (a content policy in the page forbids it). Light and dark as the reader's system is.
/// All text is escaped. The page is well-formed XML too. Not thread-safe.
/// </remarks>
public sealed class HtmlReport
{
    private readonly List<Action<XmlWriter>> _blocks = [];
    private readonly string _title;
    private readonly string _introduction;
    private readonly ReportFooter _footer;

    /// <summary>Creates an empty report.</summary>
    /// <param name="title">The title of page and text.</param>
    /// <param name="introduction">A few sentences on the contents.</param>
    /// <param name="footer">The information needed to reproduce the report.</param>
    /// <exception cref="ArgumentException">The title is empty.</exception>
    public HtmlReport(string title, string introduction, ReportFooter footer)
    {
        ArgumentException.ThrowIfNullOrEmpty(title);
        ArgumentNullException.ThrowIfNull(introduction);
        ArgumentNullException.ThrowIfNull(footer);
        _title = title;
        _introduction = introduction;
        _footer = footer;
    }

    /// <summary>Adds a heading.</summary>
    public HtmlReport AddHeading(string text) => Add(html => Element(html, "h2", text));

    /// <summary>Adds a paragraph.</summary>
    public HtmlReport AddParagraph(string text) => Add(html => Element(html, "p", text));

    /// <summary>Adds a sentence with the result, set to be read first.</summary>
    public HtmlReport AddFinding(string text) => Add(html => Element(html, "p", text, "finding"));

    /// <summary>Adds a table, with explanations of its words below it if there are any.</summary>
    /// <param name="table">The table.</param>
    /// <param name="terms">The words that the table uses, each with its meaning; null for none.</param>
    public HtmlReport AddTable(ReportTable table, IReadOnlyList<(string Word, string Meaning)>? terms = null)
    {
        ArgumentNullException.ThrowIfNull(table);
        return Add(html =>
        {
            WriteTable(html, table);
            if (terms?.Count > 0)
            {
                WriteTerms(html, terms);
            }
        });
    }

    /// <summary>Adds a chart as inline SVG, with a caption below it unless that is empty.</summary>
    public HtmlReport AddChart(LineChart chart, string caption = "")
    {
        ArgumentNullException.ThrowIfNull(chart);
        return Add(html =>
        {
            html.WriteStartElement("figure");
            chart.WriteTo(html);
            if (!string.IsNullOrEmpty(caption))
            {
                Element(html, "figcaption", caption);
            }

            html.WriteEndElement();
        });
    }

    /// <summary>Writes the page to a file as UTF-8 without a byte order mark.</summary>
    /// <exception cref="IOException">The file cannot be written.</exception>
    public void Save(string path)
    {
        using StreamWriter file = new(path, append: false, new UTF8Encoding(encoderShouldEmitUTF8Identifier: false));
        Write(file);
    }

    /// <summary>Writes the page. The writer stays open.</summary>
    public void Write(TextWriter output)
    {
        ArgumentNullException.ThrowIfNull(output);
        using XmlWriter html = XmlWriter.Create(output, MarkupText.Settings);
        html.WriteDocType("html", null, null, null);
        html.WriteStartElement("html");
        html.WriteAttributeString("lang", "en");
        WriteHead(html);
        html.WriteStartElement("body");
        html.WriteStartElement("main");
        Element(html, "h1", _title);
        Element(html, "p", _introduction);
        foreach (Action<XmlWriter> block in _blocks)
        {
            block(html);
        }

        html.WriteEndElement();
        WriteFooter(html);
        html.WriteEndElement();
        html.WriteEndElement();
    }

    private HtmlReport Add(Action<XmlWriter> block)
    {
        _blocks.Add(block);
        return this;
    }

    private void WriteHead(XmlWriter html)
    {
        html.WriteStartElement("head");
        Meta(html, "charset", "utf-8", null);
        Meta(html, "name", "viewport", "width=device-width, initial-scale=1");
        Meta(html, "name", "color-scheme", "light dark");
        Meta(html, "http-equiv", "Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'");
        Element(html, "title", _title);
        Element(html, "style", ReportTheme.Css);
        html.WriteEndElement();
    }

    private static void WriteTable(XmlWriter html, ReportTable table)
    {
        html.WriteStartElement("div");
        html.WriteAttributeString("class", "scroll");
        html.WriteStartElement("table");
        if (table.Caption.Length > 0)
        {
            Element(html, "caption", table.Caption);
        }

        html.WriteStartElement("thead");
        WriteRow(html, table, table.Columns, "th");
        html.WriteEndElement();
        html.WriteStartElement("tbody");
        foreach (IReadOnlyList<string> row in table.Rows)
        {
            WriteRow(html, table, row, "td");
        }

        html.WriteFullEndElement();
        html.WriteEndElement();
        html.WriteEndElement();
    }

    private static void WriteTerms(XmlWriter html, IReadOnlyList<(string Word, string Meaning)> terms)
    {
        html.WriteStartElement("dl");
        foreach ((string word, string meaning) in terms)
        {
            html.WriteStartElement("div");
            Element(html, "dt", word);
            Element(html, "dd", meaning);
            html.WriteEndElement();
        }

        html.WriteEndElement();
    }

    private static void WriteRow(XmlWriter html, ReportTable table, IReadOnlyList<string> cells, string element)
    {
        html.WriteStartElement("tr");
        for (int column = 0; column < cells.Count; column++)
        {
            Element(html, element, cells[column], table.IsNumeric[column] ? "n" : null);
        }

        html.WriteEndElement();
    }

    private void WriteFooter(XmlWriter html)
    {
        html.WriteStartElement("footer");
        html.WriteString(MarkupText.Clean($"Made by {_footer.Tool} {_footer.Version}, seed {_footer.Seed.ToString(CultureInfo.InvariantCulture)}"));
        if (_footer.SceneHash is { } hash)
        {
            html.WriteString(", scene ");
            Element(html, "code", hash);
        }

        html.WriteEndElement();
    }

    private static void Meta(XmlWriter html, string attribute, string value, string? content)
    {
        html.WriteStartElement("meta");
        html.WriteAttributeString(attribute, value);
        if (content is not null)
        {
            html.WriteAttributeString("content", content);
        }

        html.WriteEndElement();
    }

    /// <summary>Writes a text element, always with an end tag, since HTML has no short form of one.</summary>
    private static void Element(XmlWriter html, string name, string text, string? cssClass = null)
    {
        html.WriteStartElement(name);
        if (cssClass is not null)
        {
            html.WriteAttributeString("class", cssClass);
        }

        html.WriteString(MarkupText.Clean(text));
        html.WriteFullEndElement();
    }
}
