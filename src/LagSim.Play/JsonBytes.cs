using System;
using System.IO;
using System.Text.Json;

namespace LagSim.Play;

/// <summary>A JSON object as UTF-8 bytes: what a page and its host tell each other.</summary>
internal static class JsonBytes
{
    /// <summary>Returns the object that has what is written into it.</summary>
    internal static byte[] Of(Action<Utf8JsonWriter> write)
    {
        using MemoryStream stream = new();
        using (Utf8JsonWriter json = new(stream))
        {
            json.WriteStartObject();
            write(json);
            json.WriteEndObject();
        }

        return stream.ToArray();
    }
}
