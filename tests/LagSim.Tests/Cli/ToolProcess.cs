using System;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Runtime.InteropServices;
using LagSim.Cli;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>The built tool as a process of its own.</summary>
internal sealed class ToolProcess : IDisposable
{
    private const int Hangup = 1; // SIGHUP
    private const int Interrupt = 2; // SIGINT

    /// <summary>What runs the tool.</summary>
    internal static readonly string Dotnet =
        Path.Combine(RuntimeEnvironment.GetRuntimeDirectory(), "..", "..", "..", OperatingSystem.IsWindows() ? "dotnet.exe" : "dotnet");

    private readonly Process process;
    private readonly string line;

    private ToolProcess(string line)
    {
        this.line = line;
        ProcessStartInfo start = new(Dotnet)
        {
            RedirectStandardOutput = true,
            RedirectStandardError = true,
            RedirectStandardInput = true,
        };
        start.ArgumentList.Add(typeof(Program).Assembly.Location);
        foreach (string word in line.Split(' '))
        {
            start.ArgumentList.Add(word);
        }

        process = new Process { StartInfo = start };
        process.OutputDataReceived += (_, data) => Take(Output, data.Data);
        process.ErrorDataReceived += (_, data) => Take(Error, data.Data);
        process.Start();
        process.BeginOutputReadLine();
        process.BeginErrorReadLine();
    }

    internal LineWriter Output { get; } = new();

    internal LineWriter Error { get; } = new();

    /// <summary>Where it listens: the first line it prints.</summary>
    internal string Address
    {
        get
        {
            string first = Output.WaitFor(_ => true, LiveTool.Deadline) ?? $"nothing: {this}";
            Assert.StartsWith("listening on 127.0.0.1:", first, StringComparison.Ordinal);
            return first["listening on ".Length..];
        }
    }

    /// <summary>Starts the tool with a command line, split at blanks.</summary>
    internal static ToolProcess Start(string line) => new(line);

    /// <summary>Types a line.</summary>
    internal void Types(string text)
    {
        process.StandardInput.WriteLine(text);
        process.StandardInput.Flush();
    }

    /// <summary>Waits for a line that begins like this.</summary>
    internal void Says(string begin) => Assert.True(
        Output.WaitFor(said => said.StartsWith(begin, StringComparison.Ordinal), LiveTool.Deadline) is not null, $"'{line}' does not say '{begin}': {this}");

    /// <summary>Whether this process was started with Ctrl-C ignored, as a shell does with what it runs in the background: then so are those it starts.</summary>
    internal static bool IgnoresControlC() => Ignores(Interrupt);

    /// <summary>Whether this process was started with the end of its terminal ignored, as by <c>nohup</c>.</summary>
    internal static bool IgnoresHangup() => Ignores(Hangup);

    private static bool Ignores(int signal)
    {
        const string status = "/proc/self/status";
        string? ignored = File.Exists(status) ? File.ReadLines(status).FirstOrDefault(line => line.StartsWith("SigIgn:", StringComparison.Ordinal)) : null;
        return ignored is not null && (Convert.ToUInt64(ignored.Split('\t')[1], 16) & (1UL << (signal - 1))) != 0;
    }

    /// <summary>Presses Ctrl-C.</summary>
    internal void PressControlC() => Assert.Equal(0, Kill(process.Id, Interrupt));

    /// <summary>Closes its terminal.</summary>
    internal void CloseTerminal() => Assert.Equal(0, Kill(process.Id, Hangup));

    internal void KillAtOnce() => process.Kill();

    /// <summary>Waits for the end.</summary>
    internal ToolProcess Ends(int code)
    {
        int ended = ExitCode();
        Assert.True(ended == code, $"'{line}' ended with {ended}, not {code}: {this}");
        return this;
    }

    /// <summary>Waits for the end, and for all that it said.</summary>
    internal int ExitCode()
    {
        Assert.True(process.WaitForExit(LiveTool.Deadline), $"'{line}' does not end: {this}");
        process.WaitForExit(); // until all it said is here
        return process.ExitCode;
    }

    public override string ToString() => $"\n{Output}{Error}";

    public void Dispose()
    {
        if (!process.HasExited)
        {
            process.Kill();
            process.WaitForExit();
        }

        process.Dispose();
        Output.Dispose();
        Error.Dispose();
    }

    private static void Take(LineWriter to, string? text)
    {
        if (text is not null)
        {
            to.WriteLine(text);
        }
    }

    [DllImport("libc", EntryPoint = "kill")]
    private static extern int Kill(int process, int signal);
}
