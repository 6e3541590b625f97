using System.Text;
using System.Xml;

namespace LagSim.Harness.Reports.Charts;

/// <summary>Text from outside made fit for XML. Escaping is the writer's work; this replaces what XML cannot hold at all.</summary>
internal static class MarkupText
{
    /// <summary>The settings under which charts and reports are written: the same bytes on every system.</summary>
    internal static XmlWriterSettings Settings => new()
    {
        OmitXmlDeclaration = true, // UTF-8 is the default without it
        Indent = true,
        IndentChars = " ",
        NewLineChars = "\n",
        CloseOutput = false,
    };

    /// <summary>The text, with U+FFFD for control characters and lone surrogates.</summary>
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
