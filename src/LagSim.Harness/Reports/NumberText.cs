using System.Globalization;
using LagSim.Testing.Text;

namespace LagSim.Harness.Reports;

/// <summary>Formats numbers as text, the same in every culture.</summary>
public static class NumberText
{
    /// <summary>Returns the shortest text that reads back as the same number, for files.</summary>
    public static string RoundTrip(double value) => value.ToString("R", CultureInfo.InvariantCulture);

    /// <summary>Returns a count with its noun: "1 heal", "2 heals"; with a format of <c>N0</c> "1,200 heals".</summary>
    public static string Count(long number, string thing, string format = "0", string? many = null) =>
        number.ToString(format, CultureInfo.InvariantCulture) + " " + (number == 1 ? thing : many ?? thing + "s");

    /// <summary>Returns four significant digits, with an exponent only where a plain number would be unwieldy, for readers.</summary>
    public static string Short(double value) => ShortNumber.Of(value);
}
