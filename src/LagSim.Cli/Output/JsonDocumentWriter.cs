using System;
using System.Globalization;
using System.IO;
using System.Text;
using System.Text.Encodings.Web;
using System.Text.Json;

namespace LagSim.Cli.Output;

/// <summary>Writes a command's JSON document, with the keys that every document begins with.</summary>
internal static class JsonDocumentWriter
{
    internal static void Write(
        TextWriter output, string command, ulong? seed, string? scene, ulong? sceneHash, ulong? stateHash, Action<Utf8JsonWriter> body)
    {
        using MemoryStream bytes = new();
        using (Utf8JsonWriter json = new(bytes, new JsonWriterOptions { Indented = true, Encoder = JavaScriptEncoder.UnsafeRelaxedJsonEscaping }))
        {
            json.WriteStartObject();
            json.WriteString("tool", "lagsim");
            json.WriteString("version", ToolVersion.Text);
            json.WriteString("command", command);
            if (seed is ulong number)
            {
                json.WriteNumber("seed", number);
            }
            else
            {
                json.WriteNull("seed"); // the given value is no seed
            }

            json.WriteString("scene", scene);
            json.WriteString("scene_hash", Hash(sceneHash));
            json.WriteString("state_hash", Hash(stateHash));
            body(json);
            json.WriteEndObject();
        }

        output.WriteLine(Encoding.UTF8.GetString(bytes.ToArray()));
    }

    /// <summary>Writes 16 hexadecimal digits; null for none.</summary>
    internal static string? Hash(ulong? hash) => hash?.ToString("x16", CultureInfo.InvariantCulture);

    /// <summary>Writes a number, or null for NaN, which JSON does not have.</summary>
    internal static void Number(Utf8JsonWriter json, string key, double? value)
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
