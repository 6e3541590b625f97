using System;
using System.IO;

namespace LagSim.Cli.Output;

/// <summary>Where a command writes a result: a file, or stdout, which stays open.</summary>
internal sealed class ResultFile : IDisposable
{
    internal const string StandardOutput = "-";

    private readonly bool owned;

    private ResultFile(TextWriter writer, bool owned)
    {
        Writer = writer;
        this.owned = owned;
    }

    internal TextWriter Writer { get; }

    /// <summary>Opens what the option names; null for none.</summary>
    internal static ResultFile? Open(ToolConsole console, string? name) =>
        name is null ? null
        : name == StandardOutput ? new ResultFile(console.Output, owned: false)
        : new ResultFile(new StreamWriter(name), owned: true);

    /// <summary>Tries out whether a file can be written, and leaves everything as it was.</summary>
    /// <exception cref="IOException">It cannot.</exception>
    /// <exception cref="UnauthorizedAccessException">The same, for lack of permission.</exception>
    internal static void ThrowIfNotWritable(string name)
    {
        bool isThere = File.Exists(name);
        using (new FileStream(name, FileMode.OpenOrCreate, FileAccess.Write, FileShare.ReadWrite))
        {
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
            Writer.Flush(); // whatever ended the run, its rows so far are results
        }
    }
}
