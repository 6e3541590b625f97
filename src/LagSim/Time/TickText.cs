using System;
using System.Globalization;
using System.Numerics;
using System.Text;

namespace LagSim.Time;

/// <summary>
/// The exact decimal text of a number of ticks. A multiple of 2^-40 always has a finite decimal form of at most 40 decimals.
/// </summary>
internal static class TickText
{
    private const int MaxDecimals = 40;
    private const int MaxLength = 64;

    internal static string Format(long ticks)
    {
        StringBuilder text = new();
        ulong magnitude = ticks < 0 ? (ulong)-(ticks + 1) + 1 : (ulong)ticks;
        if (ticks < 0)
        {
            text.Append('-');
        }

        text.Append((magnitude >> 40).ToString(CultureInfo.InvariantCulture));
        ulong fraction = magnitude & (SimDuration.TicksPerSecond - 1);
        if (fraction != 0)
        {
            text.Append('.');
        }

        while (fraction != 0)
        {
            fraction *= 10; // below 10 x 2^40: fits
            text.Append((char)('0' + (int)(fraction >> 40)));
            fraction &= SimDuration.TicksPerSecond - 1;
        }

        return text.Append('s').ToString();
    }

    /// <summary>
    /// Rounded to the fewest decimals that are nearer to these ticks than to any others: 13 always are, a tick is 9.1e-13 s.
    /// </summary>
    internal static string Shortest(long ticks)
    {
        BigInteger magnitude = BigInteger.Abs(ticks), digits = magnitude >> 40, scale = 1;
        int decimals = 0;
        while (((digits << 40) + (scale >> 1)) / scale != magnitude)
        {
            decimals++;
            scale *= 10;
            digits = ((magnitude * scale) + (1L << 39)) >> 40;
        }

        string text = digits.ToString(CultureInfo.InvariantCulture).PadLeft(decimals + 1, '0');
        string point = decimals == 0 ? "" : "." + text.Substring(text.Length - decimals);
        return (ticks < 0 ? "-" : "") + text.Substring(0, text.Length - decimals) + point + "s";
    }

    internal static long Parse(string text)
    {
        if (text is null)
        {
            throw new ArgumentNullException(nameof(text));
        }

        if (text.Length > MaxLength)
        {
            throw new FormatException($"A time has at most {MaxLength} characters; this text has {text.Length}.");
        }

        int at = text.StartsWith("-", StringComparison.Ordinal) ? 1 : 0;
        BigInteger digits = 0;
        int wholeDigits = 0, decimals = 0;
        bool point = false;
        for (; at < text.Length && text[at] != 's'; at++)
        {
            char c = text[at];
            if (c == '.' && !point && wholeDigits > 0)
            {
                point = true;
            }
            else if (c is >= '0' and <= '9' && (!point || decimals < MaxDecimals))
            {
                digits = (digits * 10) + (c - '0');
                wholeDigits += point ? 0 : 1;
                decimals += point ? 1 : 0;
            }
            else
            {
                throw NotATime(text);
            }
        }

        if (at != text.Length - 1 || wholeDigits == 0 || (point && decimals == 0))
        {
            throw NotATime(text);
        }

        BigInteger ticks = BigInteger.DivRem(digits << 40, BigInteger.Pow(10, decimals), out BigInteger remainder);
        if (!remainder.IsZero)
        {
            throw new FormatException($"'{text}' is not a whole number of ticks of 2^-40 s.");
        }

        ticks = text[0] == '-' ? -ticks : ticks;
        if (ticks < long.MinValue || ticks > long.MaxValue)
        {
            throw new FormatException($"'{text}' is out of range: a time is within 97 days (2^23 s) of zero.");
        }

        return (long)ticks;
    }

    private static FormatException NotATime(string text) =>
        new($"'{text}' is not a time: expected decimal seconds with a trailing s, such as 12.25s.");
}
