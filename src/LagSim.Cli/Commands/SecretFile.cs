using System;
using System.IO;
using System.Text;
using LagSim.Cli.Output;

namespace LagSim.Cli.Commands;

/// <summary>A file of one line that only this user may read, where the system supports that: a player's pass, a host's identity.</summary>
internal static class SecretFile
{
    private const int MaxBytes = 1_000; // the longest secret is one line of 64 characters

    /// <summary>Reads the line; null if the file does not exist yet, empty if it is too long to be a secret.</summary>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal static string? Read(string file)
    {
        if (!File.Exists(file))
        {
            return null;
        }

        using FileStream stream = File.OpenRead(file); // a special file may have no end
        byte[] bytes = new byte[MaxBytes];
        int length = stream.ReadAtLeast(bytes, MaxBytes, throwOnEndOfStream: false);
        return length < MaxBytes ? Encoding.UTF8.GetString(bytes, 0, length).Trim() : "";
    }

    /// <summary>Reads the secret of the file; draws one and keeps it if the file does not exist yet.</summary>
    /// <param name="option">The option that names the file.</param>
    /// <param name="file">The file.</param>
    /// <param name="what">What it keeps, as "a host's identity".</param>
    /// <param name="parse">Reads a secret from its text; null if the text is none.</param>
    /// <param name="draw">Draws a secret, and gives its text.</param>
    /// <exception cref="InputException">The file holds something else.</exception>
    /// <exception cref="IOException">The file cannot be read, or not be written.</exception>
    internal static T ReadOrDraw<T>(string option, string file, string what, Func<string, T?> parse, Func<(T Secret, string Text)> draw)
        where T : class
    {
        if (Read(file) is string text)
        {
            return parse(text) ?? throw new InputException(
                $"{option} is '{file}', which does not hold {what}: 64 hexadecimal digits in lower case.");
        }

        ThrowIfNotWritable(option, file, what);
        (T drawn, string drawnText) = draw();
        return Write(file, drawnText, overwrite: false) ? drawn : ReadOrDraw(option, file, what, parse, draw); // another process was first
    }

    /// <summary>Checks that the file could be written, and changes nothing.</summary>
    /// <param name="option">The option that names the file.</param>
    /// <param name="file">The file.</param>
    /// <param name="what">What it keeps, as "a pass".</param>
    /// <exception cref="UsageException">The name is not a file name.</exception>
    /// <exception cref="IOException">It could not be written; the message names the option, the file and the cause.</exception>
    internal static void ThrowIfNotWritable(string option, string file, string what)
    {
        if (file == ResultFile.StandardOutput)
        {
            throw new UsageException($"{option} is '-'; {what} is not for stdout, it must be a file.");
        }

        if (File.Exists(file))
        {
            ResultFile.ThrowIfNotWritable(option, file);
        }

        try
        {
            ResultFile.ThrowIfNotWritable(option, DraftOf(file)); // it is written beside the file first
        }
        catch (IOException failure) when (failure.InnerException is not null)
        {
            throw WriteFailure.Of(option, file, "a file that can be written", failure.InnerException);
        }
    }

    /// <summary>Writes the line, over another.</summary>
    internal static void Write(string file, string secret) => Write(file, secret, overwrite: true);

    private static bool Write(string file, string secret, bool overwrite)
    {
        string draft = DraftOf(file); // moved into place afterwards, so that a kill in between leaves the old file whole
        File.Delete(draft); // a leftover may be readable by others
        FileStreamOptions options = new() { Mode = FileMode.CreateNew, Access = FileAccess.Write };
        if (!OperatingSystem.IsWindows())
        {
            options.UnixCreateMode = UnixFileMode.UserRead | UnixFileMode.UserWrite;
        }

        using (StreamWriter writer = new(draft, options))
        {
            writer.WriteLine(secret);
        }

        try
        {
            File.Move(draft, file, overwrite);
            return true;
        }
        catch (IOException) when (!overwrite && File.Exists(file))
        {
            File.Delete(draft);
            return false;
        }
    }

    private static string DraftOf(string file) => $"{file}.{Environment.ProcessId}.new";
}
