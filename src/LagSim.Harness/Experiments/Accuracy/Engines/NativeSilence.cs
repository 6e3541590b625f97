using System;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>
/// Discards what native code prints to C's <c>stdout</c> while it lasts. Output of .NET is not affected. Works on Linux with glibc and on
/// macOS; elsewhere it does nothing.
/// </summary>
internal sealed unsafe class NativeSilence : IDisposable
{
    private readonly NativeFunctions library = OperatingSystem.IsMacOS() ? new NativeFunctions("libSystem.dylib") : OperatingSystem.IsLinux() ? new NativeFunctions("libc.so.6") : new NativeFunctions();
    private readonly nint* stream;
    private readonly nint kept;

    internal NativeSilence()
    {
        if (!library.IsThere)
        {
            return;
        }

        // C's stdout is an assignable variable there. The file descriptor below it stays as it is for all other code.
        delegate* unmanaged[Cdecl]<byte*, byte*, nint> open = (delegate* unmanaged[Cdecl]<byte*, byte*, nint>)library.Find("fopen");
        nint nowhere;
        fixed (byte* path = "/dev/null"u8, mode = "w"u8)
        {
            nowhere = open(path, mode);
        }

        if (nowhere != 0)
        {
            stream = (nint*)library.Find(OperatingSystem.IsMacOS() ? "__stdoutp" : "stdout");
            (kept, *stream) = (*stream, nowhere);
        }
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        if (stream != null)
        {
            nint nowhere = *stream;
            *stream = kept;
            ((delegate* unmanaged[Cdecl]<nint, int>)library.Find("fclose"))(nowhere);
        }
    }
}
