using System;
using System.IO;
using LagSim.Cli.Output;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary>A file that keeps a player's pass between runs of <c>lagsim join</c>.</summary>
internal static class PassFile
{
    /// <summary>Reads the pass; returns none if the file does not exist yet.</summary>
    /// <exception cref="InputException">The file holds something else.</exception>
    /// <exception cref="IOException">The file cannot be read.</exception>
    internal static PlayerPass Read(string file) =>
        SecretFile.Read(file) is not string text ? default
        : PlayerPass.TryParse(text, out PlayerPass pass) ? pass
        : throw new InputException(
            $"--pass is '{file}', which holds no player's pass: a number from 1 to 255, a hyphen, and 32 hexadecimal digits.");

    /// <summary>Copies a pass that another player's is about to replace, since it may be of use at another host.</summary>
    /// <returns>The name of the copy; null if it could not be made.</returns>
    internal static string? KeepFormer(string file)
    {
        string copy = file + ".old";
        try
        {
            SecretFile.Replace(copy, draft => File.Copy(file, draft)); // with the same permissions
            return copy;
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException)
        {
            return null;
        }
    }
}
