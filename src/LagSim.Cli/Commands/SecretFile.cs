using System;
using System.IO;
using System.Text;
using LagSim.Cli.Output;

namespace LagSim.Cli.Commands;

/// <summary>A file of one line that only this user may read, where the system supports that: a player's pass, a host's identity.</summary>
internal static class SecretFile
{
    private const string Must = "a file that can be written";

    private static readonly UTF8Encoding Strict = new(encoderShouldEmitUTF8Identifier: false, throwOnInvalidBytes: true);

    private const int MaxBytes = 1_000; // the longest secret is a connect key, one line

    /// <summary>Reads the line; null if the file does not exist yet, empty if it is too long to be a secret.</summary>
    /// <exception cref="InputException">It is not valid UTF-8.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal static string? Read(string file)
    {
        return ReadLine(file)?.Trim();
    }

    /// <summary>Reads the line with all the blanks that it has; null if the file does not exist yet, empty if it is too long to be a secret.</summary>
    /// <exception cref="InputException">It is not valid UTF-8: a decoder that is not strict would make the same of many secrets.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal static string? ReadLine(string file)
    {
        file = TargetOf(file); // a link to nothing exists, too
        if (!File.Exists(file))
        {
            return null;
        }

        using FileStream stream = File.OpenRead(file); // a special file may have no end
        byte[] bytes = new byte[MaxBytes];
        int length = stream.ReadAtLeast(bytes, MaxBytes, throwOnEndOfStream: false);
        string text = length < MaxBytes ? Text(file, bytes.AsSpan(0, length)) : "";
        return text.EndsWith("\r\n", StringComparison.Ordinal) ? text[..^2] : text.EndsWith('\n') ? text[..^1] : text;
    }

    private static string Text(string file, ReadOnlySpan<byte> bytes)
    {
        try
        {
            return Strict.GetString(bytes);
        }
        catch (DecoderFallbackException failure)
        {
            throw new InputException($"'{file}' is not valid UTF-8; a secret is a line of text.", failure);
        }
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
        bool isWritten = false;
        Tell(option, file, () => isWritten = Write(file, drawnText, overwrite: false));
        return isWritten ? drawn : ReadOrDraw(option, file, what, parse, draw); // another process was first
    }

    /// <summary>Writes, and says of what cannot be written which option names it and what comes of that.</summary>
    /// <param name="option">The option that names the file.</param>
    /// <param name="file">The file.</param>
    /// <param name="write">Writes it.</param>
    /// <param name="after">What is so if it fails, as a sentence that follows another; empty for nothing to say.</param>
    /// <exception cref="IOException">It could not be written; the message names the option, the file and the cause.</exception>
    internal static void Tell(string option, string file, Action write, string after = "")
    {
        try
        {
            write();
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            IOException told = WriteFailure.Of(option, file, Must, failure);
            throw after.Length == 0 ? told : new IOException($"{told.Message.TrimEnd('.')}. {after}", failure);
        }
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
            ResultFile.ThrowIfNotWritable(option, DraftOf(TargetOf(file))); // it is written beside the file first
        }
        catch (IOException failure) when (failure.InnerException is not null)
        {
            throw WriteFailure.Of(option, file, Must, failure.InnerException);
        }
    }

    /// <summary>Writes the line, over another.</summary>
    internal static void Write(string file, string secret) => Write(file, secret, overwrite: true);

    /// <summary>Writes a file beside its place and moves it there, so that a kill or a full disk in between leaves the old one whole.</summary>
    /// <param name="file">Its place. If that is a symbolic link, the file that it leads to is replaced, and the link stays.</param>
    /// <param name="write">Writes the file of that name, which does not exist. If it fails, what it wrote is deleted.</param>
    /// <param name="overwrite">Whether to replace a file that is there.</param>
    /// <returns>False if one was there and was not to be replaced.</returns>
    /// <exception cref="IOException">It could not be written.</exception>
    internal static bool Replace(string file, Action<string> write, bool overwrite = true)
    {
        file = TargetOf(file);
        string draft = DraftOf(file);
        try
        {
            File.Delete(draft); // a leftover may be readable by others
            write(draft);
            File.Move(draft, file, overwrite);
            return true;
        }
        catch (IOException) when (!overwrite && File.Exists(file))
        {
            return false;
        }
        finally
        {
            DeleteIfThere(draft);
        }
    }

    private static bool Write(string file, string secret, bool overwrite) => Replace(file, draft =>
    {
        FileStreamOptions options = new() { Mode = FileMode.CreateNew, Access = FileAccess.Write };
        if (!OperatingSystem.IsWindows())
        {
            options.UnixCreateMode = UnixFileMode.UserRead | UnixFileMode.UserWrite;
        }

        using StreamWriter writer = new(draft, options);
        writer.WriteLine(secret);
    }, overwrite);

    private static void DeleteIfThere(string file)
    {
        try
        {
            File.Delete(file);
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            // Why the file could not be written is told already.
        }
    }

    /// <summary>The file that a symbolic link leads to, in the end; the file itself if it is none.</summary>
    internal static string TargetOf(string file)
    {
        const int longest = 40; // links that lead to one another in a circle end as an error of who opens the file
        for (int n = 0; n < longest && new FileInfo(file).LinkTarget is string next; n++)
        {
            file = Path.GetFullPath(next, Path.GetDirectoryName(Path.GetFullPath(file))!); // which need not exist
        }

        return file;
    }

    private static string DraftOf(string file) => $"{file}.{Environment.ProcessId}.new";
}
