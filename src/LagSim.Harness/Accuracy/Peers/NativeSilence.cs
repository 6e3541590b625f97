using System;
using System.Runtime.InteropServices;

namespace LagSim.Harness.Accuracy.Peers;

/// <summary>While it lasts, what native code prints to stdout is thrown away; on Unix alone, and nothing managed may be printed meanwhile.</summary>
internal sealed class NativeSilence : IDisposable
{
    private const int StandardOutput = 1;
    private const int WriteOnly = 1;

    private readonly int kept = -1;

    internal NativeSilence()
    {
        if (OperatingSystem.IsWindows())
        {
            return;
        }

        Flush(0);
        kept = Duplicate(StandardOutput);
        int nowhere = Open("/dev/null", WriteOnly);
        if (nowhere >= 0)
        {
            DuplicateTo(nowhere, StandardOutput);
            Close(nowhere);
        }
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        if (kept >= 0)
        {
            Flush(0); // what is still buffered would come out later
            DuplicateTo(kept, StandardOutput);
            Close(kept);
        }
    }

    [DllImport("libc", EntryPoint = "fflush")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int Flush(nint stream);

    [DllImport("libc", EntryPoint = "dup")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int Duplicate(int file);

    [DllImport("libc", EntryPoint = "dup2")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int DuplicateTo(int file, int to);

    [DllImport("libc", EntryPoint = "open", CharSet = CharSet.Ansi, BestFitMapping = false, ThrowOnUnmappableChar = true)]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int Open(string path, int flags);

    [DllImport("libc", EntryPoint = "close")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int Close(int file);
}
