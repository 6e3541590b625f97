using System;
using System.Text;
using System.Text.Json;

namespace LagSim.Harness.SceneFiles;

/// <summary>Error messages for invalid JSON, and quoting of text from a file.</summary>
internal static class JsonFault
{
    private const int MaxShown = 40;

    /// <summary>Returns the error in a document that the JSON reader refused, and its line.</summary>
    internal static string Describe(ReadOnlySpan<byte> json, JsonException failure, out int line)
    {
        line = (int)Math.Min(failure.LineNumber ?? 0, int.MaxValue - 1) + 1;
        int at = OffsetOf(json, failure);
        if (json.Trim(" \t\r\n"u8).IsEmpty)
        {
            line = 0;
            return $"the file is empty; a scene is a JSON object with \"format\": \"{SceneFile.Format}\"";
        }

        if (IsNotANumber(json, at))
        {
            return "NaN and infinity are refused everywhere in a scene; a number must be finite";
        }

        if (at < json.Length && json[at] == '/')
        {
            return "comments are not allowed in a scene file";
        }

        if (at < json.Length && json[at] is (byte)']' or (byte)'}' && json[..at].TrimEnd(" \t\r\n"u8) is [.., (byte)','])
        {
            return "a comma stands before a closing bracket; trailing commas are not allowed";
        }

        // The rest of the library's message is the position, which is already named.
        string message = failure.Message;
        int place = message.IndexOf(" LineNumber:", StringComparison.Ordinal);
        return $"this is not valid JSON at byte {at + 1}: {Clip(place < 0 ? message : message[..place], 300)}";
    }

    /// <summary>Returns the line of a byte, counted from 1.</summary>
    internal static int LineOf(ReadOnlySpan<byte> json, long at) => json[..(int)Math.Min(at, json.Length)].Count((byte)'\n') + 1;

    /// <summary>Returns the offset at which a text stops being UTF-8.</summary>
    internal static int FirstInvalid(ReadOnlySpan<byte> text)
    {
        int at = 0;
        while (at < text.Length && Rune.DecodeFromUtf8(text[at..], out _, out int used) == System.Buffers.OperationStatus.Done)
        {
            at += used;
        }

        return at;
    }

    /// <summary>Quotes a text from a file on one line, without control characters and of limited length.</summary>
    internal static string Quote(string text) => "\"" + Clip(text, MaxShown) + "\"";

    /// <summary>Whether a text is a usual spelling of NaN or infinity.</summary>
    internal static bool IsNotANumber(ReadOnlySpan<byte> json, int at)
    {
        // The reader stops at the word, behind its sign, or at the second letter where the first could begin "null".
        int start = at;
        while (start > 0 && start > at - 4 && (char.IsAsciiLetter((char)json[start - 1]) || json[start - 1] is (byte)'-' or (byte)'+'))
        {
            start--;
        }

        ReadOnlySpan<byte> rest = start < json.Length ? json[start..].TrimStart("+-"u8) : default;
        return StartsWith(rest, "nan"u8) || StartsWith(rest, "inf"u8) || rest.StartsWith("\u221E"u8);
    }

    internal static string Clip(string text, int most)
    {
        StringBuilder shown = new();
        foreach (Rune rune in text.EnumerateRunes())
        {
            if (shown.Length >= most)
            {
                return shown.Append('…').ToString();
            }

            shown.Append(Rune.IsControl(rune) ? "\uFFFD" : rune.ToString());
        }

        return shown.ToString();
    }

    private static bool StartsWith(ReadOnlySpan<byte> text, ReadOnlySpan<byte> lowercase) =>
        text.Length >= lowercase.Length && Ascii.EqualsIgnoreCase(text[..lowercase.Length], lowercase);

    private static int OffsetOf(ReadOnlySpan<byte> json, JsonException failure)
    {
        int at = 0;
        for (long line = failure.LineNumber ?? 0; line > 0; line--)
        {
            int feed = json[at..].IndexOf((byte)'\n');
            if (feed < 0)
            {
                break;
            }

            at += feed + 1;
        }

        return (int)Math.Min(at + (failure.BytePositionInLine ?? 0), json.Length);
    }
}
