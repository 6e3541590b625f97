using System.Globalization;
using System.Text.Json;

namespace LagSim.Harness.Reports;

/// <summary>Values of the tool's JSON that JSON itself has no form for.</summary>
public static class JsonValues
{
    /// <summary>Returns a hash as 16 hexadecimal digits; null for none.</summary>
    public static string? Hash(ulong? hash) => hash?.ToString("x16", CultureInfo.InvariantCulture);

    /// <summary>Writes a number, or null for none and for one that is not finite, which JSON does not have.</summary>
    public static void Number(Utf8JsonWriter json, string key, double? value)
    {
        if (value is double number && double.IsFinite(number))
        {
            json.WriteNumber(key, number);
        }
        else
        {
            json.WriteNull(key);
        }
    }
}
