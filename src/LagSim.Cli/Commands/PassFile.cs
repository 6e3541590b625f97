using System;
using System.IO;
using System.Text;
using LagSim.Cli.Output;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary>A file that keeps a player's pass between runs of <c>lagsim join</c>.</summary>
internal static class PassFile
{
    private const int MaxBytes = 1_000; // a pass is one line of at most 36

    /// <summary>Reads the pass; returns none if the file does not exist yet.</summary>
    /// <exception cref="InputException">The file holds something else.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal static PlayerPass Read(string file)
    {
        if (!File.Exists(file))
        {
            return default;
        }

        using FileStream stream = File.OpenRead(file); // a special file may have no end
        byte[] bytes = new byte[MaxBytes];
        int length = stream.ReadAtLeast(bytes, MaxBytes, throwOnEndOfStream: false);
        return length < MaxBytes && PlayerPass.TryParse(Encoding.UTF8.GetString(bytes, 0, length), out PlayerPass pass)
            ? pass
            : throw new InputException($"--pass is '{file}', which holds no player's pass: a number from 1 to 255, a hyphen, and 32 hexadecimal digits.");
    }

    /// <summary>Checks that a pass could be written, and changes nothing.</summary>
    /// <exception cref="UsageException">The name is not a file name.</exception>
    /// <exception cref="IOException">A pass could not be written; the message names the option, the file and the cause.</exception>
    internal static void ThrowIfNotWritable(string file)
    {
        if (file == ResultFile.StandardOutput)
        {
            throw new UsageException("--pass is '-'; a pass is not for stdout, it must be a file.");
        }

        if (File.Exists(file))
        {
            ResultFile.ThrowIfNotWritable("--pass", file);
        }

        try
        {
            ResultFile.ThrowIfNotWritable("--pass", DraftOf(file)); // it is written beside the file first
        }
        catch (IOException failure) when (failure.InnerException is not null)
        {
            throw WriteFailure.Of("--pass", file, "a file that can be written", failure.InnerException);
        }
    }

    /// <summary>Copies a pass that another player's is about to replace, since it may be of use at another host.</summary>
    /// <returns>The name of the copy; null if it could not be made.</returns>
    internal static string? KeepFormer(string file)
    {
        string copy = file + ".old";
        try
        {
            File.Copy(file, copy, overwrite: true); // with the same permissions
            return copy;
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            return null;
        }
    }

    private static string DraftOf(string file) => file + ".new";

    /// <summary>Writes a pass, readable only by this user where the system supports that.</summary>
    internal static void Write(string file, PlayerPass pass)
    {
        string draft = DraftOf(file); // moved into place afterwards, so that a kill in between leaves the old file whole
        FileStreamOptions options = new() { Mode = FileMode.Create, Access = FileAccess.Write };
        if (!OperatingSystem.IsWindows())
        {
            options.UnixCreateMode = UnixFileMode.UserRead | UnixFileMode.UserWrite;
        }

        using (StreamWriter writer = new(draft, options))
        {
            writer.WriteLine(pass.ToString());
        }

        File.Move(draft, file, overwrite: true);
    }
}
