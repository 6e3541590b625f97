using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using System.Text;
using System.Threading;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>The tool in its own process, with its output recorded: a host, a client or a relay.</summary>
internal sealed class StallProcess : IDisposable
{
    private readonly Process process;
    private readonly object gate = new();
    private readonly List<string> lines = [];
    private readonly StringBuilder output = new();

    /// <summary>Starts the process.</summary>
    /// <param name="tool">The program, and the arguments that it needs before its own.</param>
    /// <param name="arguments">The arguments of the tool.</param>
    internal StallProcess(IReadOnlyList<string> tool, IEnumerable<string> arguments)
    {
        ProcessStartInfo start = new(tool[0]) { RedirectStandardOutput = true, RedirectStandardError = true, RedirectStandardInput = true };
        foreach (string argument in tool.Skip(1).Concat(arguments))
        {
            start.ArgumentList.Add(argument);
        }

        process = Process.Start(start) ?? throw new InvalidOperationException($"'{tool[0]}' was not started.");
        process.ErrorDataReceived += (_, line) => Keep(line.Data);
        process.OutputDataReceived += (_, line) =>
        {
            Keep(line.Data);
            lock (gate)
            {
                output.AppendLine(line.Data);
            }
        };
        process.BeginErrorReadLine();
        process.BeginOutputReadLine();
    }

    /// <summary>The output so far, line by line, results and progress.</summary>
    internal string[] Lines
    {
        get
        {
            lock (gate)
            {
                return [.. lines];
            }
        }
    }

    /// <summary>The output to stdout.</summary>
    internal string Output
    {
        get
        {
            lock (gate)
            {
                return output.ToString();
            }
        }
    }

    internal bool HasExited => process.HasExited;

    internal int Id => process.Id;

    /// <summary>Sends a signal by name, as <c>STOP</c>.</summary>
    internal void Signal(string name)
    {
        using Process kill = Process.Start("kill", [$"-{name}", process.Id.ToString(CultureInfo.InvariantCulture)]);
        kill.WaitForExit();
    }

    /// <summary>Kills the process without a goodbye, and waits until it is gone.</summary>
    internal void Kill()
    {
        process.Kill();
        process.WaitForExit();
    }

    /// <summary>Waits for a line with a prefix.</summary>
    /// <returns>The rest of the line; null if it did not arrive in time, or if the process has ended.</returns>
    internal string? Await(string beginning, double seconds, CancellationToken cancellation)
    {
        for (Stopwatch watch = Stopwatch.StartNew(); watch.Elapsed.TotalSeconds < seconds;)
        {
            bool isLast = process.HasExited;
            if (Lines.FirstOrDefault(line => line.StartsWith(beginning, StringComparison.Ordinal)) is string found)
            {
                return found[beginning.Length..];
            }

            if (isLast)
            {
                return null;
            }

            cancellation.WaitHandle.WaitOne(50);
            cancellation.ThrowIfCancellationRequested();
        }

        return null;
    }

    /// <summary>Waits for the end of the process and all its output; returns false if it still runs.</summary>
    internal bool AwaitEnd(double seconds, CancellationToken cancellation)
    {
        for (Stopwatch watch = Stopwatch.StartNew(); !process.HasExited;)
        {
            if (watch.Elapsed.TotalSeconds >= seconds)
            {
                return false;
            }

            cancellation.WaitHandle.WaitOne(50);
            cancellation.ThrowIfCancellationRequested();
        }

        process.WaitForExit();
        return true;
    }

    public void Dispose()
    {
        if (!process.HasExited)
        {
            Kill();
        }

        process.Dispose();
    }

    private void Keep(string? line)
    {
        if (line is not null)
        {
            lock (gate)
            {
                lines.Add(line);
            }
        }
    }
}
