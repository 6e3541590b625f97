using System;
using System.Globalization;

namespace LagSim.Harness.Reports;

/// <summary>Numbers as text, the same in every culture.</summary>
public static class NumberText
{
    /// <summary>The shortest text that reads back as the very same number; for files.</summary>
    public static string RoundTrip(double value) => value.ToString("R", CultureInfo.InvariantCulture);

    /// <summary>So many of a thing: "1 heal", "2 heals"; with a format of <c>N0</c> "1,200 heals".</summary>
    public static string Count(long number, string thing, string format = "0", string? many = null) =>
        number.ToString(format, CultureInfo.InvariantCulture) + " " + (number == 1 ? thing : many ?? thing + "s");

    /// <summary>Four significant digits, with an exponent only where a plain number would be unwieldy; for readers.</summary>
    public static string Short(double value)
    {
        double size = Math.Abs(value);
        if (value == 0.0 || !double.IsFinite(value))
        {
            return value == 0.0 ? "0" : RoundTrip(value);
        }

        if (size < 1e-4 || size >= 1e7)
        {
            return value.ToString("0.###e0", CultureInfo.InvariantCulture);
        }

        int decimals = Math.Clamp(3 - (int)Math.Floor(Math.Log10(size)), 0, 7);
        return value.ToString("0." + new string('#', decimals), CultureInfo.InvariantCulture);
    }
}
