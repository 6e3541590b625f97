using System;
using System.IO;

namespace LagSim.Cli.Output;

/// <summary>
/// The folder of <c>--out</c>. It is checked before a long run, but only created when there is something to write.
/// </summary>
internal static class OutputFolder
{
    /// <summary>Checks that the folder can be written, and changes nothing.</summary>
    /// <exception cref="IOException">The folder cannot be created, or nothing can be written to it.</exception>
    internal static void ThrowIfNotWritable(string folder)
    {
        string path = Path.TrimEndingDirectorySeparator(Path.GetFullPath(folder));
        string? there = path;
        while (there is not null && !Directory.Exists(there))
        {
            there = Path.GetDirectoryName(there);
        }

        try
        {
            Directory.CreateDirectory(path);
            using FileStream probe = new(
                Path.Combine(path, $".lagsim-{Guid.NewGuid():N}"), FileMode.CreateNew, FileAccess.Write, FileShare.None, 1, FileOptions.DeleteOnClose);
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            throw WriteFailure.Of("--out", folder, "a folder that can be made and written to", failure);
        }
        finally
        {
            RemoveEmpty(path, there);
        }
    }

    /// <summary>
    /// Removes a folder, and its parents up to one that existed before. A folder that holds anything stays.
    /// </summary>
    private static void RemoveEmpty(string? path, string? upTo)
    {
        try
        {
            for (; path is not null && path != upTo; path = Path.GetDirectoryName(path))
            {
                Directory.Delete(path);
            }
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
        }
    }
}
