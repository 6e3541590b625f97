using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Threading.Tasks;
using Xunit;

namespace LagSim.Browser;

/// <summary>A run of <c>lagsim</c> as a process, and all that it has said.</summary>
internal sealed class ToolProcess : IAsyncDisposable
{
    private static readonly TimeSpan Patience = TimeSpan.FromSeconds(120);

    private readonly Process process;
    private readonly List<string> lines = [];

    internal ToolProcess(params IEnumerable<string> arguments)
    {
        string tool = Path.Combine(ServedPage.Root, "src/LagSim.Cli/bin/Release/net10.0/LagSim.Cli.dll");
        process = Process.Start(new ProcessStartInfo("dotnet", [tool, .. arguments]) { RedirectStandardOutput = true, RedirectStandardError = true })!;
        process.OutputDataReceived += (_, line) => Note(line.Data);
        process.ErrorDataReceived += (_, line) => Note(line.Data);
        process.BeginOutputReadLine();
        process.BeginErrorReadLine();
    }

    /// <summary>Whether it has ended.</summary>
    internal bool HasEnded => process.HasExited;

    /// <summary>How much memory it has.</summary>
    internal long ResidentBytes
    {
        get
        {
            process.Refresh();
            return process.WorkingSet64;
        }
    }

    /// <summary>All lines so far.</summary>
    internal string[] Lines
    {
        get
        {
            lock (lines)
            {
                return [.. lines];
            }
        }
    }

    /// <summary>The lines of committed states, by their time.</summary>
    internal IReadOnlyDictionary<string, string> States => StatesOf(Lines);

    /// <summary>Of lines, those of committed states, by their time.</summary>
    internal static IReadOnlyDictionary<string, string> StatesOf(IEnumerable<string> lines) =>
        lines.Where(line => line.StartsWith("T ", StringComparison.Ordinal)).ToDictionary(line => line.Split(' ')[1]);

    /// <summary>Waits for a line that begins so, and returns the rest of it.</summary>
    internal async Task<string> AfterAsync(string begin) => (await SaysAsync(line => line.StartsWith(begin, StringComparison.Ordinal)))[begin.Length..];

    /// <summary>Waits for a line, and returns it.</summary>
    internal async Task<string> SaysAsync(Func<string, bool> isIt)
    {
        Stopwatch waited = Stopwatch.StartNew();
        while (true)
        {
            if (Lines.FirstOrDefault(isIt) is string found)
            {
                return found;
            }

            Assert.True(waited.Elapsed < Patience && !HasEnded, $"lagsim did not say it, but: {string.Join('\n', Lines)}");
            await Task.Delay(50);
        }
    }

    /// <summary>Waits for its end, and returns its exit code.</summary>
    internal async Task<int> EndAsync()
    {
        await process.WaitForExitAsync().WaitAsync(Patience);
        return process.ExitCode;
    }

    /// <summary>Has it end as a person does who presses Ctrl+C.</summary>
    internal async Task EndInOrderAsync()
    {
        using Process kill = Process.Start("kill", ["-TERM", $"{process.Id}"]);
        await kill.WaitForExitAsync();
        await EndAsync();
    }

    public async ValueTask DisposeAsync()
    {
        if (!process.HasExited)
        {
            process.Kill(entireProcessTree: true);
        }

        await process.WaitForExitAsync();
        process.Dispose();
    }

    private void Note(string? line)
    {
        lock (lines)
        {
            lines.AddRange(line is null ? [] : [line]);
        }
    }
}
