using System;
using System.IO;

namespace LagSim.Cli.Output;

/// <summary>The destination of a result: a file, or stdout, which stays open.</summary>
internal sealed class ResultFile : IDisposable
{
    internal const string StandardOutput = "-";

    private const string Must = "a file that can be written";

    private readonly bool owned;

    private ResultFile(TextWriter writer, bool owned)
    {
        Writer = writer;
        this.owned = owned;
    }

    internal TextWriter Writer { get; }

    /// <summary>Opens the file of an option; null for none.</summary>
    /// <exception cref="IOException">The file cannot be written; the message names the option, the file and the cause.</exception>
    internal static ResultFile? Open(ToolConsole console, string option, string? name)
    {
        if (name is null or StandardOutput)
        {
            return name is null ? null : new ResultFile(console.Output, owned: false);
        }

        try
        {
            return new ResultFile(new StreamWriter(name), owned: true);
        }
        catch (Exception failure) when (WriteFailure.Is(failure))
        {
            throw WriteFailure.Of(option, name, Must, failure);
        }
    }

    /// <summary>Checks that a file can be written, and changes nothing.</summary>
    /// <exception cref="IOException">The file cannot be written; the message names the option, the file and the cause.</exception>
    internal static void ThrowIfNotWritable(string option, string name)
    {
        bool isThere = File.Exists(name);
        try
        {
            using FileStream probe = new(name, FileMode.OpenOrCreate, FileAccess.Write, FileShare.ReadWrite);
        }
        catch (Exception failure) when (WriteFailure.Is(failure))
        {
            throw WriteFailure.Of(option, name, Must, failure);
        }

        if (!isThere)
        {
            File.Delete(name);
        }
    }

    public void Dispose()
    {
        if (owned)
        {
            Writer.Dispose();
        }
        else
        {
            Writer.Flush(); // however the run ended, its rows so far are results
        }
    }
}
