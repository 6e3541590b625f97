using System;
using System.Globalization;

namespace LagSim.Net.Protection;

/// <summary>Bytes as lower-case hexadecimal digits.</summary>
internal static class HexText
{
    internal static string Of(ReadOnlySpan<byte> bytes)
    {
        System.Text.StringBuilder text = new(2 * bytes.Length);
        foreach (byte b in bytes)
        {
            text.Append(b.ToString("x2", CultureInfo.InvariantCulture));
        }

        return text.ToString();
    }

    /// <summary>Reads exactly as many bytes as the destination has; false for any other spelling than <see cref="Of"/> gives.</summary>
    internal static bool TryRead(string text, Span<byte> destination)
    {
        if (text.Length != 2 * destination.Length)
        {
            return false;
        }

        for (int n = 0; n < destination.Length; n++)
        {
            int high = Digit(text[2 * n]);
            int low = Digit(text[(2 * n) + 1]);
            if (high < 0 || low < 0)
            {
                return false;
            }

            destination[n] = (byte)((high << 4) | low);
        }

        return true;
    }

    private static int Digit(char digit) => digit switch
    {
        >= '0' and <= '9' => digit - '0',
        >= 'a' and <= 'f' => digit - 'a' + 10,
        _ => -1,
    };
}
