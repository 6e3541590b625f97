using System;
using System.IO;
using LagSim.Cli.Output;
using LagSim.Play;
using LagSim.Net.Recordings;

namespace LagSim.Cli.Commands;

/// <summary>A recording that a command opens by name.</summary>
internal static class RecordingFile
{
    /// <exception cref="InputException">The file cannot be opened; the message names it and the cause.</exception>
    internal static Recording Read(string name)
    {
        try
        {
            return Recording.Read(name, rules: AirHockeyGame.AllRules());
        }
        catch (Exception failure) when (failure is IOException or UnauthorizedAccessException or ArgumentException)
        {
            throw new InputException($"'{name}' cannot be read as a recording: {Cause(name, failure)}");
        }
    }

    private static string Cause(string name, Exception failure) => failure switch
    {
        FileNotFoundException or DirectoryNotFoundException => "there is no such file.",
        UnauthorizedAccessException when Directory.Exists(name) => "it is a folder.",
        UnauthorizedAccessException => "permission to read it is denied.",
        _ => Sentence.Of(failure),
    };
}
