using System;
using System.Text;

namespace LagSim.Net.Wire;

/// <summary>Text on the wire: a byte with its length in bytes, then UTF-8 without a byte order mark.</summary>
internal static class WireText
{
    /// <summary>The longest text, in bytes of UTF-8. A name of 64 characters takes at most 192.</summary>
    internal const int MaxBytes = byte.MaxValue;

    /// <summary>The encoded length of a text, in bytes.</summary>
    /// <exception cref="ArgumentException">It cannot be encoded; the message says why and whose it is.</exception>
    internal static int EncodedLength(string text, string whose)
    {
        if (!IsUnicode(text))
        {
            throw new ArgumentException($"{whose} cannot travel: '{text}' has half a surrogate pair in it, which UTF-8 has no form for.");
        }

        int length = Encoding.UTF8.GetByteCount(text);
        if (length > MaxBytes)
        {
            throw new ArgumentException($"{whose} cannot travel: '{text}' takes {length} bytes in UTF-8; at most {MaxBytes} are allowed.");
        }

        return 1 + length;
    }

    /// <summary>Writes a text whose <see cref="EncodedLength"/> is known.</summary>
    internal static void Write(ref WireWriter writer, string text)
    {
        byte[] utf8 = Encoding.UTF8.GetBytes(text);
        writer.WriteByte((byte)utf8.Length);
        writer.WriteBytes(utf8);
    }

    /// <summary>Reads a text; the reader refuses what is not UTF-8. Never throws.</summary>
    internal static string Read(ref WireReader reader)
    {
        reader.Require(TryDecode(reader.ReadBytes(reader.ReadByte()), out string text));
        return text;
    }

    /// <summary>Decodes these bytes as text; false if they are not UTF-8. Never throws.</summary>
    internal static bool TryDecode(ReadOnlySpan<byte> utf8, out string text)
    {
        text = Encoding.UTF8.GetString(utf8);
        return utf8.SequenceEqual(Encoding.UTF8.GetBytes(text)); // invalid UTF-8 became U+FFFD, whose bytes differ
    }

    private static bool IsUnicode(string text)
    {
        int at = 0;
        while (at < text.Length && (!char.IsSurrogate(text[at]) || char.IsSurrogatePair(text, at)))
        {
            at += char.IsSurrogate(text[at]) ? 2 : 1;
        }

        return at >= text.Length;
    }
}
