using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Cli;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>One call of the tool, in this process.</summary>
internal sealed class Tool
{
    private const int Usage = 2;

    private Tool(int exitCode, string output, string error)
    {
        ExitCode = exitCode;
        Output = output;
        Error = error;
    }

    internal int ExitCode { get; }

    internal string Output { get; }

    /// <summary>The output with every run of white space as one space, so that it does not matter where lines were wrapped.</summary>
    internal string OutputOnOneLine => string.Join(' ', Output.Split((char[]?)null, StringSplitOptions.RemoveEmptyEntries));

    internal string Error { get; }

    internal static Tool Run(params string[] arguments)
    {
        using StringWriter output = new(), error = new();
        int code = Program.Run(arguments, output, error, TestContext.Current.CancellationToken);
        return new Tool(code, output.ToString(), error.ToString());
    }

    /// <summary>A call that must be refused with that exit code, and all of these in what it says; on stdout nothing, or the same as JSON if that was asked for.</summary>
    internal static void Refuses(int exitCode, string[] arguments, params string[] says)
    {
        Tool tool = Run(arguments);
        Assert.True(exitCode == tool.ExitCode, $"{string.Join(' ', arguments)}: exit code {tool.ExitCode}: {tool.Error}");
        if (arguments.Contains("--json"))
        {
            using JsonDocument document = JsonDocument.Parse(tool.Output);
            Assert.Equal(
                ["tool", "version", "command", "seed", "scene", "scene_hash", "state_hash", "error", "exit_code"],
                document.RootElement.EnumerateObject().Select(property => property.Name));
            Assert.Equal((arguments[0], exitCode), (document.RootElement.GetProperty("command").GetString(), document.RootElement.GetProperty("exit_code").GetInt32()));
            Assert.Contains(says[0], document.RootElement.GetProperty("error").GetString(), StringComparison.Ordinal);
        }
        else
        {
            Assert.Equal("", tool.Output);
        }

        Assert.Equal(exitCode == Usage, tool.Error.TrimEnd().Split('\n')[^1].StartsWith("Try 'lagsim ", StringComparison.Ordinal)); // where the help is, after each mistake
        Assert.All(says, word => Assert.Contains(word, tool.Error, StringComparison.Ordinal));
        Assert.DoesNotContain("   at ", tool.Error, StringComparison.Ordinal); // a sentence, not a stack
    }

    internal Tool Done()
    {
        Assert.True(ExitCode == 0, $"exit code {ExitCode}: {Error}");
        return this;
    }
}

/// <summary>A folder of a test's own, gone afterwards.</summary>
internal sealed class TemporaryFolder : IDisposable
{
    internal string Path { get; } = Directory.CreateTempSubdirectory("lagsim-test-").FullName;

    internal string this[string name] => System.IO.Path.Combine(Path, name);

    public void Dispose() => Directory.Delete(Path, recursive: true);
}
