using System;
using System.Threading;
using LagSim.Cli;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>A call of the tool that goes on, in this process, on a thread of its own.</summary>
internal sealed class LiveTool : IDisposable
{
    internal static readonly TimeSpan Deadline = TimeSpan.FromSeconds(30);

    private readonly CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(TestContext.Current.CancellationToken);
    private readonly Thread thread;
    private readonly string[] arguments;
    private int? exitCode;

    internal LiveTool(params string[] arguments)
    {
        this.arguments = arguments;
        thread = new Thread(() => exitCode = Program.Run(arguments, Output, Error, stop.Token)) { IsBackground = true, Name = arguments[0] };
        thread.Start();
    }

    internal LineWriter Output { get; } = new();

    internal LineWriter Error { get; } = new();

    /// <summary>Where it listens: the first line it prints.</summary>
    internal string Address
    {
        get
        {
            string? line = Output.WaitFor(_ => true, Deadline) ?? "nothing";
            Assert.StartsWith("listening on ", line, StringComparison.Ordinal);
            return line["listening on ".Length..];
        }
    }

    /// <summary>The command line of one, split at blanks.</summary>
    internal static LiveTool Run(string line, params string[] more) => new([.. line.Split(' '), .. more]);

    /// <summary>Presses Ctrl-C.</summary>
    internal void Stop() => stop.Cancel();

    /// <summary>Waits for the end.</summary>
    internal LiveTool Ends(int code)
    {
        Assert.True(thread.Join(Deadline), $"'{string.Join(' ', arguments)}' does not end: {this}");
        Assert.True(exitCode == code, $"'{string.Join(' ', arguments)}' ended with {exitCode}, not {code}: {this}");
        return this;
    }

    public override string ToString() => $"\n{Output}{Error}";

    public void Dispose()
    {
        stop.Cancel();
        thread.Join(Deadline);
        stop.Dispose();
        Output.Dispose();
        Error.Dispose();
    }
}
