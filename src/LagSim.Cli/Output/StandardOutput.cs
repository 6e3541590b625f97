using System;
using System.IO;
using System.Text;
using Microsoft.Win32.SafeHandles;

namespace LagSim.Cli.Output;

/// <summary>
/// The standard output for results: buffered where it is no terminal, and with an error when the reader of a pipe has gone.
/// </summary>
internal static class StandardOutput
{
    private const int BrokenPipe = 32; // EPIPE

    internal static TextWriter Open() =>
        Console.IsOutputRedirected ? Writer(Pipe(1) ?? Console.OpenStandardOutput()) : Console.Out;

    /// <summary>
    /// Whether writing failed because the reader closed the pipe, as <c>lagsim ... | head -1</c> does. That is no error.
    /// </summary>
    internal static bool IsClosedPipe(IOException failure) => failure.HResult == BrokenPipe;

    /// <summary>
    /// Opens the pipe of a descriptor; null if it is something else. <see cref="Console"/>'s own stream hides that a pipe is closed.
    /// </summary>
    internal static Stream? Pipe(nint descriptor)
    {
        if (OperatingSystem.IsWindows())
        {
            return null; // it has no such descriptors; a run continues to its end there
        }

        try
        {
            FileStream stream = new(new SafeFileHandle(descriptor, ownsHandle: false), FileAccess.Write, bufferSize: 0);
            return stream.CanSeek ? null : stream; // the file's position must stay where the shell's next command expects it
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException or ArgumentException)
        {
            return null; // closed from the start
        }
    }

    private static StreamWriter Writer(Stream stream) => new(new NamedStream("stdout", stream), new UTF8Encoding(encoderShouldEmitUTF8Identifier: false));
}
