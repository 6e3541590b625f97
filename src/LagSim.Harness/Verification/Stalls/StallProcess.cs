using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using System.Text;
using System.Threading;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>The tool as a process of its own, with what it says kept: a host, a client or a relay.</summary>
internal sealed class StallProcess : IDisposable
{
    private readonly Process process;
    private readonly object gate = new();
    private readonly List<string> lines = [];
    private readonly StringBuilder output = new();

    /// <summary>Starts it.</summary>
    /// <param name="tool">The program, and the arguments that it needs before its own.</param>
    /// <param name="arguments">Its own.</param>
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

    /// <summary>What it said by now, line by line, results and progress.</summary>
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

    /// <summary>What it wrote to its standard output.</summary>
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

    /// <summary>Sends it a signal by its name, as <c>STOP</c>.</summary>
    internal void Signal(string name)
    {
        using Process kill = Process.Start("kill", [$"-{name}", process.Id.ToString(CultureInfo.InvariantCulture)]);
        kill.WaitForExit();
    }

    /// <summary>Ends it at once, without a goodbye, and waits until it is gone.</summary>
    internal void Kill()
    {
        process.Kill();
        process.WaitForExit();
    }

    /// <summary>Waits for a line that begins so.</summary>
    /// <returns>The rest of the line; null if it did not come in time, or the process has ended.</returns>
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

    /// <summary>Waits for its end, and for all that it said; false if it goes on.</summary>
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
