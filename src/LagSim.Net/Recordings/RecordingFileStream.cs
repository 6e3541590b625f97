using System.IO;
using System.Runtime.InteropServices;

namespace LagSim.Net.Recordings;

/// <summary>Opens a recording's file such that others may read it meanwhile but no other process writes it.</summary>
internal static class RecordingFileStream
{
    /// <summary>Opens the file, empty.</summary>
    /// <exception cref="IOException">It cannot be created or written, or another process is writing a recording to it.</exception>
    internal static FileStream Open(string path)
    {
        using (FileStream before = new(path, FileMode.OpenOrCreate, FileAccess.Write, FileShare.Read))
        {
            ThrowIfLocked(before); // before its content is truncated
        }

        FileStream file = new(path, FileMode.Create, FileAccess.Write, FileShare.Read);
        try
        {
            ThrowIfLocked(file);
            return file;
        }
        catch
        {
            file.Dispose();
            throw;
        }
    }

    /// <summary>
    /// Locks a file for this process. Windows enforces the sharing mode; Linux affects only processes that ask for locks, so any process
    /// can read.
    /// </summary>
    private static void ThrowIfLocked(FileStream file)
    {
        if (!RuntimeInformation.IsOSPlatform(OSPlatform.Linux) || !file.CanSeek)
        {
            return;
        }

        try
        {
            file.Lock(0, 1);
        }
        catch (IOException locked)
        {
            throw new IOException($"'{file.Name}' cannot be recorded to: another process is writing it.", locked);
        }
    }
}
