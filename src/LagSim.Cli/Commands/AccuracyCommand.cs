using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Accuracy;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim accuracy</c>: speed against error, LagSim beside other engines and integrators.</summary>
internal static class AccuracyCommand
{
    private const string All = "all";
    private const string None = "none";

    private static string Names => string.Join(", ", WorkScenes.All.Select(scene => scene.Name));

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Argument<string> which = new("SCENE")
        {
            Description = $"{All}, or one of {Names}; or {WorkScenes.Drawn}, some heaps that the seed draws.",
            DefaultValueFactory = _ => All,
        };
        Option<string> peers = CommonOptions.Word(
            "--peers", "Which engines and integrators to compare with LagSim.", All, [All, None, .. WorkMethods.Peers]);
        Option<bool> quick = new("--quick")
        {
            Description = "Few settings, short runs and small heaps: takes some seconds, but its figures of speed cannot be trusted."
                + " Cannot be combined with --longest-s.",
        };
        Option<double> longest = CommonOptions.Number("--longest-s", "How long a single run may take, estimated from the next coarser setting; what would"
            + " take longer is left out. Cannot be combined with --quick", new WorkOptions().LongestSeconds, 1e-3, 1e5);
        Command command = new("accuracy", "Speed against error: runs each scene with each method at a range of step sizes; gives tables, CSV and charts.") { which, peers, quick, longest };
        common.AddTo(command, isSeedDrawnFrom: false);
        common.Seed.Description = $"What {WorkScenes.Drawn} are drawn by; of all other scenes nothing here is random.";
        command.SetAction(parsed =>
        {
            string name = parsed.GetValue(which)!, peer = parsed.GetValue(peers)!;
            IReadOnlyList<WorkScene> scenes = name == All ? WorkScenes.All
                : name == WorkScenes.Drawn ? WorkScenes.Draw(parsed.GetValue(common.Seed))
                : WorkScenes.TryGet(name, out WorkScene? found) ? [found]
                : throw new UsageException($"SCENE is '{name}'; it must be {All} or one of {Names}, {WorkScenes.Drawn}.");
            IWorkMethod[] methods = [.. WorkMethods.All.Where(method => peer == All || method.Engine == peer || !WorkMethods.Peers.Contains(method.Engine))];
            ThrowIfNotThere(peer, scenes);
            bool isQuick = parsed.GetValue(quick);
            scenes = isQuick ? [.. scenes.Select(scene => scene.Small)] : scenes;
            WorkOptions options = isQuick ? WorkOptions.Quick : new WorkOptions { LongestSeconds = parsed.GetValue(longest) };
            if (isQuick && parsed.GetResult(longest) is { Implicit: false })
            {
                throw new UsageException("--quick and --longest-s exclude each other: a quick look has its own limit.");
            }

            return Run(console, scenes, methods, options, parsed.GetValue(common.Seed), parsed.GetValue(common.Out), parsed.GetValue(common.Json));
        });
        return command;
    }

    /// <summary>
    /// Throws if the only engine asked for is missing, or suits none of the scenes: there is no result then.
    /// </summary>
    private static void ThrowIfNotThere(string peer, IReadOnlyList<WorkScene> scenes)
    {
        IWorkMethod[] asked = [.. WorkMethods.All.Where(method => method.Engine == peer)];
        if (asked.Length > 0 && asked.All(method => method.Missing is not null))
        {
            throw new InputException($"--peers is '{peer}', which is missing here: {asked[0].Missing}.");
        }

        if (asked.Length > 0 && asked.All(method => scenes.All(scene => method.Excludes(scene) is not null)))
        {
            throw new UsageException($"--peers is '{peer}', which is left out of {scenes[0].Name}: {asked[0].Excludes(scenes[0])}.");
        }
    }

    private static int Run(
        ToolConsole console, IReadOnlyList<WorkScene> scenes, IReadOnlyList<IWorkMethod> methods, WorkOptions options, ulong seed, string? folder, bool json)
    {
        if (folder is not null)
        {
            OutputFolder.ThrowIfNotWritable(folder);
        }

        string title = scenes.Count == 1 ? $"accuracy {scenes[0].Name}" : "accuracy";
        WorkReport work = console.WithProgress(title, 1, progress => WorkSweep.Run(scenes, methods, options, progress, console.Stop, console.Begin));
        if (work is { StoppedAt: not null, Points.Count: 0 })
        {
            throw new OperationCanceledException(console.Stop);
        }

        AccuracyReport report = new(scenes, work, options == WorkOptions.Quick, seed);
        if (folder is not null)
        {
            AccuracyFiles.Write(folder, report);
        }

        if (json)
        {
            AccuracyJson.Write(console.Output, report);
        }
        else
        {
            AccuracyTables.Write(console, report, folder);
        }

        return work.StoppedAt is null ? ExitCode.Done : ExitCode.Interrupted;
    }
}
