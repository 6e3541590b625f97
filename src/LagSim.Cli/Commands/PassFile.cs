using System;
using System.IO;
using System.Text;
using LagSim.Cli.Output;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary>The file that keeps a player's pass from one run of <c>lagsim join</c> to the next.</summary>
internal static class PassFile
{
    private const int MaxBytes = 1_000; // a pass is one line of at most 36

    /// <summary>The pass in the file; none if there is no such file yet.</summary>
    /// <exception cref="InputException">The file holds something else.</exception>
    /// <exception cref="IOException">It cannot be read.</exception>
    internal static PlayerPass Read(string file)
    {
        if (!File.Exists(file))
        {
            return default;
        }

        using FileStream stream = File.OpenRead(file); // what is no plain file may have no end
        byte[] bytes = new byte[MaxBytes];
        int length = stream.ReadAtLeast(bytes, MaxBytes, throwOnEndOfStream: false);
        return length < MaxBytes && PlayerPass.TryParse(Encoding.UTF8.GetString(bytes, 0, length), out PlayerPass pass)
            ? pass
            : throw new InputException($"--pass is '{file}', which holds no player's pass: a number from 1 to 255, a hyphen, and 32 hexadecimal digits.");
    }

    /// <summary>Tries out whether a pass could be kept, and leaves everything as it was.</summary>
    /// <exception cref="UsageException">That is no name of a file.</exception>
    /// <exception cref="IOException">It could not; the message names the option, the file and the cause.</exception>
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

    /// <summary>Keeps a copy of a pass that is about to be replaced by another player's, which may be of use at another host.</summary>
    /// <returns>The copy's name; null if it could not be made.</returns>
    internal static string? KeepFormer(string file)
    {
        string copy = file + ".old";
        try
        {
            File.Copy(file, copy, overwrite: true); // with the same rights
            return copy;
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            return null;
        }
    }

    private static string DraftOf(string file) => file + ".new";

    /// <summary>Keeps a pass, in a file that only this user may read where the system knows such a thing.</summary>
    internal static void Write(string file, PlayerPass pass)
    {
        string draft = DraftOf(file); // then moved into place, so that a kill in between leaves the old file whole
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
