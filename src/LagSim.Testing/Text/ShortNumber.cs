using System;
using System.Globalization;

namespace LagSim.Testing.Text;

/// <summary>Formats numbers for people, the same in every culture.</summary>
internal static class ShortNumber
{
    /// <summary>Formats four significant digits, with an exponent only if a plain number would be unwieldy.</summary>
    internal static string Of(double value)
    {
        double size = Math.Abs(value);
        if (value == 0.0 || !double.IsFinite(value))
        {
            return value == 0.0 ? "0" : value.ToString("R", CultureInfo.InvariantCulture);
        }

        if (size < 1e-4 || size >= 1e7)
        {
            return value.ToString("0.###e0", CultureInfo.InvariantCulture);
        }

        int decimals = Math.Clamp(3 - (int)Math.Floor(Math.Log10(size)), 0, 7);
        return value.ToString("0." + new string('#', decimals), CultureInfo.InvariantCulture);
    }
}
