using System.Text;
using System.Xml;

namespace LagSim.Harness.Reports.Charts;

/// <summary>Makes external text fit for XML. The writer escapes; this replaces what XML cannot contain at all.</summary>
internal static class MarkupText
{
    /// <summary>The settings of charts and reports: the same bytes on every system.</summary>
    internal static XmlWriterSettings Settings => new()
    {
        OmitXmlDeclaration = true, // UTF-8 is the default without it
        Indent = true,
        IndentChars = " ",
        NewLineChars = "\n",
        CloseOutput = false,
    };

    /// <summary>Replaces control characters and lone surrogates by U+FFFD.</summary>
    internal static string Clean(string text)
    {
        StringBuilder clean = new(text.Length);
        for (int i = 0; i < text.Length; i++)
        {
            if (i + 1 < text.Length && XmlConvert.IsXmlSurrogatePair(text[i + 1], text[i]))
            {
                clean.Append(text[i]).Append(text[++i]);
            }
            else
            {
                clean.Append(XmlConvert.IsXmlChar(text[i]) ? text[i] : '\ufffd');
            }
        }

        return clean.ToString();
    }
}
