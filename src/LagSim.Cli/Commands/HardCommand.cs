using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Diagnostics;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Verification.Hard;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim hard</c>: the numerical hard cases against exact references.</summary>
internal static class HardCommand
{
    private const string All = "all";

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> which = new("CASE")
        {
            Description = $"{All}, or one of {string.Join(", ", HardCases.All.Select(c => c.Name))}.",
            DefaultValueFactory = _ => All,
        };
        Option<string> scale = CommonOptions.Word(
            "--scale", "full: the sizes of the catalogue, which take some minutes; small: the sizes that the tests run, which take some seconds.", "full", "full", "small");
        Option<bool> controls = new("--controls") { Description = "Run deliberately wrong methods through the same checks; each of them must fail." };
        Command command = new("hard", "Checks numerically hard cases against exact references, each with a bound that is argued from rounding or order.")
        {
            which, scale, controls,
        };
        common.AddTo(command);
        command.SetAction(parsed =>
        {
            string name = parsed.GetValue(which)!;
            IReadOnlyList<IHardCase> cases = name == All ? HardCases.All
                : HardCases.TryGet(name, out IHardCase? found) ? [found]
                : throw new UsageException($"CASE is '{name}'; it must be {All} or one of {string.Join(", ", HardCases.All.Select(c => c.Name))}.");
            HardScale size = parsed.GetValue(scale) == "small" ? HardScale.Small : HardScale.Full;
            return Run(console, cases, size, parsed.GetValue(controls), parsed.GetValue(common.Seed), parsed.GetValue(common.Out),
                parsed.GetValue(common.Json));
        });
        return command;
    }

    /// <summary>Fails on cases that did not pass; with deliberately wrong methods, on cases that did.</summary>
    internal static int ExitCodeOf(HardReport report) => report.AsItShouldBe == report.Rows.Count ? ExitCode.Done : ExitCode.CheckFailed;

    private static int Run(ToolConsole console, IReadOnlyList<IHardCase> cases, HardScale scale, bool areControls, ulong seed, string? folder, bool json)
    {
        if (folder is not null)
        {
            OutputFolder.ThrowIfNotWritable(folder);
        }

        long began = Stopwatch.GetTimestamp();
        string? at = null;
        IReadOnlyList<HardRow> rows = console.WithProgress(
            cases.Count == 1 ? $"hard {cases[0].Name}" : "hard",
            cases.Count,
            progress => HardCases.Run(cases, scale, seed, areControls, Tell(progress), console.Stop));
        bool isStopped = console.Stop.IsCancellationRequested && rows.All(row => row.Case != cases[^1].Name);
        if (isStopped && rows.Count == 0)
        {
            throw new OperationCanceledException(console.Stop);
        }

        HardReport report = new(rows, scale, areControls, seed, Stopwatch.GetElapsedTime(began).TotalSeconds) { StoppedAt = isStopped ? at : null };
        if (folder is not null)
        {
            HardFiles.Write(folder, report);
        }

        if (json)
        {
            HardJson.Write(console.Output, report);
        }
        else
        {
            HardTables.Write(console, report, folder);
        }

        return ExitCodeOf(report) is int code and not ExitCode.Done ? code : isStopped ? ExitCode.Interrupted : ExitCode.Done;

        Action<double, string> Tell(Action<double> progress) => (done, name) =>
        {
            if (name != at)
            {
                console.Begin(at = name);
            }

            progress(done);
        };
    }
}
