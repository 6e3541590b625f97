using System;
using System.IO;

namespace LagSim.Cli.Output;

/// <summary>Formats why a file or folder cannot be written, for the user who named it.</summary>
internal static class WriteFailure
{
    /// <summary>Whether a failure is a write failure.</summary>
    internal static bool Is(Exception failure) => failure is IOException or UnauthorizedAccessException or NotSupportedException or ArgumentException;

    /// <summary>Formats a message that names the option, its value, what it must be, and why it is not.</summary>
    internal static IOException Of(string option, string name, string must, Exception failure) =>
        new($"{option} is '{name}'; it must be {must}. {Cause(name, failure)}", failure);

    /// <summary>Says why a file or folder cannot be written, as a sentence.</summary>
    internal static string Cause(string name, Exception failure)
    {
        string? above = Path.GetDirectoryName(Path.TrimEndingDirectorySeparator(Path.GetFullPath(name)));
        string? missing = null;
        while (above is not null && !Directory.Exists(above))
        {
            if (File.Exists(above))
            {
                return $"'{above}' is a file, not a folder.";
            }

            (missing, above) = (above, Path.GetDirectoryName(above));
        }

        return failure switch
        {
            UnauthorizedAccessException => $"Permission to write in '{above}' is denied.",
            DirectoryNotFoundException when missing is not null => $"There is no folder '{missing}'.",
            FileNotFoundException or DirectoryNotFoundException => $"The file system at '{above}' lets nothing be made there.",
            _ => failure.Message,
        };
    }
}
