using System;
using System.IO;
using System.Text;
using System.Text.Encodings.Web;
using System.Text.Json;
using LagSim.Harness.Reports;

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

    /// <inheritdoc cref="JsonValues.Hash"/>
    internal static string? Hash(ulong? hash) => JsonValues.Hash(hash);

    /// <inheritdoc cref="JsonValues.Number"/>
    internal static void Number(Utf8JsonWriter json, string key, double? value) => JsonValues.Number(json, key, value);
}
