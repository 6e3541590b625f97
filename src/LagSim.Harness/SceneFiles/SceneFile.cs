using System;
using System.Buffers;
using System.IO;
using System.Text;
using System.Text.Unicode;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>Reads and writes scenes as JSON files; docs/SCENES.md describes the format.</summary>
/// <remarks>
/// It is strict: anything unknown, missing, duplicated, of the wrong type or out of range is refused, with its position. Safe on any
/// thread.
/// </remarks>
public static class SceneFile
{
    /// <summary>The required value of the key <c>format</c>.</summary>
    public const string Format = "lagsim-scene-1";

    /// <summary>The largest file that is read or written, in bytes: 64 MiB.</summary>
    public const int MaxBytes = 64 << 20;

    /// <summary>Reads the scene in a file.</summary>
    /// <exception cref="SceneFileException">There is no such file, or no valid scene in it.</exception>
    public static Scene Read(string path)
    {
        ArgumentNullException.ThrowIfNull(path);
        return Parse(ReadBytes(path), path);
    }

    /// <summary>Reads a scene from the bytes of a file.</summary>
    /// <param name="utf8">The document, with or without a byte order mark.</param>
    /// <param name="file">The name for error messages.</param>
    /// <exception cref="SceneFileException">The document holds no valid scene.</exception>
    public static Scene Parse(ReadOnlySpan<byte> utf8, string file)
    {
        ArgumentNullException.ThrowIfNull(file);
        if (utf8.Length > MaxBytes)
        {
            throw TooLarge(file);
        }

        ReadOnlySpan<byte> json = utf8.StartsWith("\uFEFF"u8) ? utf8[3..] : utf8;
        if (!Utf8.IsValid(json))
        {
            int at = JsonFault.FirstInvalid(json);
            throw new SceneFileException(
                file, "", JsonFault.LineOf(json, at), $"byte {at + utf8.Length - json.Length + 1} is not UTF-8; a scene file is UTF-8 text");
        }

        SceneJsonReader reader = new(json, file, locate: null);
        try
        {
            return reader.Read();
        }
        catch (SceneException whole)
        {
            Locate(json, file, reader.SceneName);
            throw new SceneFileException(file, "", 0, whole.Message, whole);
        }
    }

    /// <summary>Returns the scene as the text of a file, ready to edit. It reads back as a scene with the same hash.</summary>
    /// <exception cref="SceneFileException">The scene supplies accelerations written in C#.</exception>
    public static string ToJson(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return Encoding.UTF8.GetString(ToBytes(scene, $"scene '{JsonFault.Clip(scene.Name, 64)}'"));
    }

    /// <summary>Writes the scene to a file, and replaces an existing one.</summary>
    /// <exception cref="SceneFileException">The scene cannot be written as JSON, or the file cannot be written.</exception>
    public static void Write(Scene scene, string path)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(path);
        byte[] bytes = ToBytes(scene, path);
        try
        {
            File.WriteAllBytes(path, bytes);
        }
        catch (Exception cause) when (IsOfFiles(cause))
        {
            throw new SceneFileException(path, "", 0, $"the file cannot be written: {cause.Message}", cause);
        }
    }

    private static byte[] ToBytes(Scene scene, string file)
    {
        if (scene.Accelerations.Count > 0)
        {
            string first = scene.Accelerations[0].Name;
            throw new SceneFileException(
                file, "", 0, $"the scene supplies accelerations written in C#, the first is '{first}'; a JSON file cannot hold code");
        }

        if (scene.Rules is SceneRules rules && BuiltInRules.Named(rules.Name)?.Version != rules.Version)
        {
            throw new SceneFileException(file, "", 0, $"the scene has the rules '{rules}', written in C#; a JSON file can name built-in rules only ({BuiltInRules.KnownNames})");
        }

        ArrayBufferWriter<byte> buffer = new();
        SceneJsonWriter.Write(scene, buffer);
        buffer.Write("\n"u8);
        return buffer.WrittenCount <= MaxBytes ? buffer.WrittenSpan.ToArray() : throw TooLarge(file);
    }

    private static void Locate(ReadOnlySpan<byte> json, string file, string scene)
    {
        try
        {
            new SceneJsonReader(json, file, locate: scene).Read();
        }
        catch (SceneException)
        {
            // Every part is valid by itself; the caller reports what is wrong with them together.
        }
    }

    // A length is unreliable: a pipe has none, and a file may grow during the read.
    private static byte[] ReadBytes(string path)
    {
        try
        {
            if (Directory.Exists(path))
            {
                throw new SceneFileException(path, "", 0, "this is a folder; a scene is a file");
            }

            using FileStream file = new(path, FileMode.Open, FileAccess.Read, FileShare.Read);
            using MemoryStream bytes = new();
            byte[] part = new byte[64 << 10];
            int read;
            while ((read = file.Read(part)) > 0)
            {
                bytes.Write(part, 0, read);
                if (bytes.Length > MaxBytes)
                {
                    throw TooLarge(path);
                }
            }

            return bytes.ToArray();
        }
        catch (Exception cause) when (IsOfFiles(cause))
        {
            throw new SceneFileException(path, "", 0, $"the file cannot be read: {cause.Message}", cause);
        }
    }

    private static bool IsOfFiles(Exception failure) =>
        failure is IOException or UnauthorizedAccessException or ArgumentException or NotSupportedException;

    private static SceneFileException TooLarge(string file) =>
        new(file, "", 0, $"larger than 64 MiB ({MaxBytes} bytes), which is the most a scene file may have");
}
