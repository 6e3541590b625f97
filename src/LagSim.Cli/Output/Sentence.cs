using System;
using System.Globalization;
using System.Text;

namespace LagSim.Cli.Output;

/// <summary>Formats failures as sentences for a terminal.</summary>
internal static class Sentence
{
    /// <summary>Returns a failure's message, without the parameter name, which only a programmer knows.</summary>
    internal static string Of(Exception failure) =>
        failure is ArgumentException { ParamName: string name } ? failure.Message.Replace($" (Parameter '{name}')", "", StringComparison.Ordinal) : failure.Message;

    /// <summary>
    /// Returns the text with control characters from input spelled out; line breaks stay.
    /// </summary>
    internal static string Printable(string text)
    {
        StringBuilder printable = new(text.Length);
        foreach (char c in text)
        {
            printable.Append(char.IsControl(c) && c != '\n' ? "\\u" + ((int)c).ToString("x4", CultureInfo.InvariantCulture) : c.ToString());
        }

        return printable.ToString();
    }
}
