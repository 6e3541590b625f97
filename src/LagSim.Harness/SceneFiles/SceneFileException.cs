using System;

namespace LagSim.Harness.SceneFiles;

/// <summary>
/// A scene file cannot be read or written. The message names the file, the position in it, what is wrong and what is allowed.
/// </summary>
public sealed class SceneFileException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public SceneFileException()
    {
    }

    /// <summary>A sentence.</summary>
    public SceneFileException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public SceneFileException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Creates an exception for a position in a file.</summary>
    /// <param name="file">The file, as the user named it.</param>
    /// <param name="path">The position in the document, such as <c>bodies[2].radius_m</c>; empty for all of it.</param>
    /// <param name="line">The line, counted from 1; 0 if none applies.</param>
    /// <param name="problem">The problem, and what is allowed.</param>
    /// <param name="innerException">The cause, if there is one.</param>
    public SceneFileException(string file, string path, int line, string problem, Exception? innerException = null)
        : base(Sentence(file, path, line, problem), innerException)
    {
        File = file;
        Path = path;
        Line = line;
    }

    /// <summary>The file, as the user named it.</summary>
    public string File { get; } = "";

    /// <summary>The position in the document, such as <c>bodies[2].radius_m</c>; empty for all of it.</summary>
    public string Path { get; } = "";

    /// <summary>The line in the file, counted from 1; 0 if none applies.</summary>
    public int Line { get; }

    private static string Sentence(string file, string path, int line, string problem)
    {
        string place = line > 0 ? $"line {line}" : "";
        if (path.Length > 0)
        {
            place = place.Length > 0 ? $"{path} ({place})" : path;
        }

        return place.Length > 0 ? $"{file}: {place}: {problem}" : $"{file}: {problem}";
    }
}
