using System.IO;
using System.Runtime.InteropServices;

namespace LagSim.Net.Recordings;

/// <summary>Opens a file for a recording, so that others may read it meanwhile and no other process writes it too.</summary>
internal static class RecordingFileStream
{
    /// <summary>The file, empty.</summary>
    /// <exception cref="IOException">It cannot be made or written, or another process is writing a recording to it.</exception>
    internal static FileStream Open(string path)
    {
        using (FileStream before = new(path, FileMode.OpenOrCreate, FileAccess.Write, FileShare.Read))
        {
            ThrowIfLocked(before); // before what it holds is cut off
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
    /// Locks a file for this process. Windows holds others to what they may share; Linux holds only those who ask for locks, so that
    /// everybody can read.
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
