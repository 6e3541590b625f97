using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.IO.Pipes;
using System.Linq;
using System.Text;
using System.Text.Json;
using System.Threading;
using LagSim.Cli;
using LagSim.Cli.Output;
using LagSim.Harness.SceneFiles;
using LagSim.Harness.SceneFiles.Runs;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Cli;

/// <summary>A run that nobody wants to go on ends, and leaves nothing half done.</summary>
public sealed class StoppingTests
{
    private const int BrokenPipe = 32;
    private const int NoSpace = 28;

    [Theory]
    [InlineData("--samples")]
    [InlineData("--events")]
    public void Run_ReaderHasGone_EndsQuietly(string table)
    {
        using FailingWriter output = new(BrokenPipe);
        using StringWriter error = new();
        Assert.Equal(141, Program.Run(["run", "pair", "--motion", "rk4", "--until-s", "40000", table, "-"], output, error, TestContext.Current.CancellationToken));
        Assert.Equal("run pair ...", error.ToString().Trim());
        Assert.Equal(1, output.Failures); // no row after the one that was not read
    }

    [Fact]
    public void Run_OutputFails_IsToldWithTheReason()
    {
        using FailingWriter output = new(NoSpace);
        using StringWriter error = new();
        Assert.Equal(3, Program.Run(["run", "pair", "--samples", "-"], output, error, TestContext.Current.CancellationToken));
        Assert.Contains("it failed", error.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void Pipe_ReaderHasGone_IsAClosedPipe()
    {
        Assert.SkipWhen(OperatingSystem.IsWindows(), "Windows has no such descriptors.");
        using AnonymousPipeServerStream writing = new(PipeDirection.Out);
        using AnonymousPipeClientStream reading = new(PipeDirection.In, writing.ClientSafePipeHandle);
        using Stream pipe = StandardOutput.Pipe(writing.SafePipeHandle.DangerousGetHandle())!;
        pipe.Write("x"u8);
        Assert.Equal('x', reading.ReadByte());
        reading.Dispose();
        Assert.True(StandardOutput.IsClosedPipe(Assert.ThrowsAny<IOException>(() => pipe.Write("x"u8))));
    }

    [Fact]
    public void Run_Interrupted_EndsWithAWholeRow()
    {
        using CancellationTokenSource stop = new();
        using StoppingWriter output = new(stop);
        using StringWriter error = new();
        Assert.Equal(130, Program.Run(["run", "pair", "--samples", "-"], output, error, stop.Token));
        string[] lines = output.ToString().Split("\r\n");
        Assert.Equal("", lines[^1]);
        Assert.InRange(lines.Length, 3, 10);
        Assert.All(lines.SkipLast(1), line => Assert.Equal(9, line.Split(',').Length));
    }

    [Fact]
    public void Join_InterruptedWhileItConnects_SaysSo()
    {
        using StringWriter output = new(), error = new();
        Assert.Equal(130, Program.Run(["join", "127.0.0.1:9", "--json"], output, error, new CancellationToken(canceled: true))); // nobody answers there
        Assert.EndsWith("Interrupted before there was a result." + Environment.NewLine, error.ToString(), StringComparison.Ordinal);
        using JsonDocument document = JsonDocument.Parse(output.ToString());
        Assert.Equal("interrupted", document.RootElement.GetProperty("error").GetString());
        Assert.Equal(130, document.RootElement.GetProperty("exit_code").GetInt32());
    }

    [Theory]
    [InlineData("drop --time virtual --out")]
    [InlineData("drop --time virtual --case same-start --json --out")]
    public void Drop_Interrupted_LeavesNoFolder(string line)
    {
        using TemporaryFolder folder = new();
        using StringWriter output = new(), error = new();
        Assert.Equal(130, Program.Run([.. line.Split(' '), folder["new/one"]], output, error, new CancellationToken(canceled: true)));
        Assert.EndsWith("Interrupted before there was a result." + Environment.NewLine, error.ToString(), StringComparison.Ordinal);
        Assert.Empty(Directory.GetFileSystemEntries(folder.Path));
        if (!line.Contains("--json", StringComparison.Ordinal))
        {
            Assert.Equal("", output.ToString());
            return;
        }

        using JsonDocument document = JsonDocument.Parse(output.ToString());
        Assert.Equal(("interrupted", 130), (document.RootElement.GetProperty("error").GetString(), document.RootElement.GetProperty("exit_code").GetInt32()));
    }

    [Theory]
    [InlineData("hard --scale small", "  spring", "cases", "spring")]
    [InlineData("accuracy drop --quick --peers none", "  drop: LagSim RungeKutta4", "points", "drop: LagSim RungeKutta4")]
    public void LongCommand_Interrupted_ReportsTheRowsSoFar(string line, string when, string rows, string at)
    {
        using CancellationTokenSource stop = new();
        using StringWriter output = new();
        using StoppingErrors error = new(when, stop);
        Assert.Equal(130, Program.Run([.. line.Split(' '), "--json"], output, error, stop.Token));
        using JsonDocument document = JsonDocument.Parse(output.ToString());
        Assert.True(document.RootElement.GetProperty("stopped_early").GetBoolean());
        Assert.Equal(at, document.RootElement.GetProperty("stopped_at").GetString());
        JsonElement[] told = [.. document.RootElement.GetProperty(rows).EnumerateArray()];
        Assert.NotEmpty(told);
        Assert.DoesNotContain(told, row => row.TryGetProperty("case", out JsonElement name) ? name.GetString() == at : row.GetProperty("method").GetString() == "LagSim RungeKutta4");
    }

    [Fact]
    public void Command_AskedToTerminate_SaysSoInItsDocument()
    {
        using StringWriter output = new(), error = new();
        Assert.Equal(143, Program.Run(["hard", "--scale", "small", "--json"], output, error, new CancellationToken(canceled: true), () => 143));
        using JsonDocument document = JsonDocument.Parse(output.ToString());
        Assert.Equal(143, document.RootElement.GetProperty("exit_code").GetInt32());
    }

    [Fact]
    public void Stdout_ThatIsFull_IsNamed()
    {
        using FullStream failing = new();
        IOException failure = Assert.Throws<IOException>(() => new NamedStream("stdout", failing).Write("x"u8));
        Assert.Equal("stdout cannot be written: no room.", failure.Message);
    }

    /// <summary>Where not even a failure can be told, as on a terminal that was closed, the tool ends with a code all the same.</summary>
    [Fact]
    [Trait("Time", "real")]
    public void Process_WhoseErrorsCannotBeWritten_EndsWithACode()
    {
        Assert.SkipUnless(File.Exists("/dev/full"), "This system has no device that is full.");
        using Process process = Process.Start("/bin/sh", ["-c", $"'{ToolProcess.Dotnet}' '{typeof(Program).Assembly.Location}' replay no-such.lagsim 2>/dev/full"]);
        Assert.True(process.WaitForExit(LiveTool.Deadline));
        Assert.Equal(3, process.ExitCode);
    }

    [Fact]
    public void Folder_TriedOut_IsAsItWas()
    {
        using TemporaryFolder folder = new();
        File.WriteAllText(folder["kept"], "");
        OutputFolder.ThrowIfNotWritable(folder.Path);
        OutputFolder.ThrowIfNotWritable(folder["new/one/"]);
        IOException failure = Assert.Throws<IOException>(() => OutputFolder.ThrowIfNotWritable(folder["kept/below"]));
        Assert.StartsWith($"--out is '{folder["kept/below"]}'; it must be a folder that can be made and written to. '{folder["kept"]}' is a file, not a folder.", failure.Message, StringComparison.Ordinal);
        Assert.Equal([folder["kept"]], Directory.GetFileSystemEntries(folder.Path));
    }

    [Fact]
    public void MinSeconds_OfSeveralRuns_TellsHowFarAllOfThemAre()
    {
        List<double> told = [];
        SceneRun.MinSeconds(BuiltInScenes.Pair(), SimDuration.FromSeconds(25), 2, told.Add, cancellation: TestContext.Current.CancellationToken);
        Assert.Equal(Enumerable.Range(1, 60).Select(n => n * 1.25), told); // twenty parts of each of two, and of one before them
        told.Clear();
        SceneRun.MinSeconds(BuiltInScenes.Pair(), SimDuration.FromSeconds(25), 2, told.Add, isWarm: true, cancellation: TestContext.Current.CancellationToken);
        Assert.Equal(40, told.Count);
    }

    [Fact]
    public void Run_OfAWorldAtRest_TakesNoSteps()
    {
        int steps = 0, events = 0;
        SceneRun run = new(BuiltInScenes.Drop()) { OnEvent = _ => events++ };
        run.Run(SimDuration.FromSeconds(900_000), _ => steps++);
        Assert.InRange(steps, 40, 60); // it rests after 12.53 s, looked at every 0.25 s
        Assert.Equal(53, events);
    }

    /// <summary>An error stream whose reader presses Ctrl-C at a certain line.</summary>
    private sealed class StoppingErrors(string when, CancellationTokenSource stop) : StringWriter
    {
        public override void WriteLine(string? value)
        {
            base.WriteLine(value);
            if (value == when)
            {
                stop.Cancel();
            }
        }
    }

    /// <summary>A stream on which there is no room.</summary>
    private sealed class FullStream : MemoryStream
    {
        public override void Write(ReadOnlySpan<byte> buffer) => throw new IOException("no room", NoSpace);
    }

    /// <summary>An output that takes some text and then fails, as a pipe does once its reader has what it wanted.</summary>
    private sealed class FailingWriter(int reason) : StringWriter
    {
        internal int Failures { get; private set; }

        public override Encoding Encoding => Encoding.UTF8;

        public override void Write(string? value)
        {
            if (GetStringBuilder().Length > 500)
            {
                Failures++;
                throw new IOException("it failed", reason);
            }

            base.Write(value);
        }
    }

    /// <summary>An output whose reader presses Ctrl-C when the first row is there.</summary>
    private sealed class StoppingWriter(CancellationTokenSource stop) : StringWriter
    {
        public override void Flush() => stop.Cancel();
    }
}
