using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Events;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Reports;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim compare</c>: every strategy on every link.</summary>
internal static class CompareCommand
{
    private const string All = "all";

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Option<string> scene = new("--scene")
        {
            Description = $"The scene to play in: {string.Join(", ", BuiltInScenes.Names)}, or any other scene by name or file, with at most"
                + $" {CompareOptions.MaxBodies} bodies, including those that players spawn.",
            DefaultValueFactory = _ => "pair",
            HelpName = "NAME",
        };
        Option<string> profile = new("--profile")
        {
            Description = $"The link between each client and the host: {string.Join(", ", LinkProfiles.All.Select(p => p.Name))},"
                + $" {LinkProfiles.AnyDelay},"
                + " or all the named ones.",
            DefaultValueFactory = _ => All,
            HelpName = "NAME",
        };
        Option<string> strategy = CommonOptions.Word("--strategy", "What a peer does with an event that arrives late.", All, [.. LateEventStrategies.Names, All]);
        Option<int> peers = CommonOptions.Whole("--peers", "How many peers, the host included", 4, 2, 9);
        Option<double> delay = CommonOptions.DisplayDelay();
        Command command = new("compare", "Compares every strategy for late events on every link, side by side, in virtual time.") { scene, profile, strategy, peers, delay };
        common.AddTo(command);
        command.SetAction(parsed =>
        {
            LinkProfile[] links = Links(parsed.GetValue(profile)!);
            string chosen = parsed.GetValue(strategy)!;
            CommonOptions.ThrowIfUnused(parsed, delay, chosen, chosen is All or CommonOptions.Interpolating);
            IReadOnlyList<string> strategies = chosen == All ? LateEventStrategies.Names : [chosen];
            Scene played = SceneSource.Load(parsed.GetValue(scene)!);
            ulong seed = parsed.GetValue(common.Seed);
            int count = parsed.GetValue(peers);
            IReadOnlyList<PlannedAction> plan = PlayerPlan.Draw(played, count, seed);
            int spawned = plan.Count(action => action.Kind == EventKind.Spawn);
            if (played.Bodies.Count + spawned > CompareOptions.MaxBodies)
            {
                throw new UsageException(
                    $"--scene is '{played.Name}' with {NumberText.Count(played.Bodies.Count, "body", many: "bodies")}, and players spawn {spawned} more; at"
                        + $" most {CompareOptions.MaxBodies} in all can be watched.");
            }

            CompareOptions[] runs = links.SelectMany(link => strategies.Select(name => new CompareOptions(played, plan, name, link)
            {
                Peers = count,
                Seed = seed,
                Cancellation = console.Stop,
                DisplayDelay = SimDuration.FromMilliseconds(parsed.GetValue(delay)),
            })).ToArray();
            return Run(console, runs, parsed.GetValue(common.Out), parsed.GetValue(common.Json));
        });
        return command;
    }

    /// <summary>Checks that strategies that promise agreement agree on every link.</summary>
    internal static int ExitCodeOf(IEnumerable<CompareRun> runs) => runs.Any(CompareTables.IsBroken) ? ExitCode.CheckFailed : ExitCode.Done;

    private static int Run(ToolConsole console, CompareOptions[] options, string? folder, bool json)
    {
        if (folder is not null)
        {
            OutputFolder.ThrowIfNotWritable(folder); // report this before minutes of work
        }

        double each = CompareOptions.Length.ToSeconds();
        List<CompareRun> runs = console.WithProgress(
            $"compare, {options[0].Scene.Name}, virtual time",
            each * options.Length,
            progress =>
            {
                WarmUp(options, progress);
                return options.Select((run, n) =>
                {
                    console.Begin($"{run.Link.Name}, {run.Strategy}");
                    return CompareTest.Run(run, done => progress((n * each) + done.ToSeconds()));
                }).ToList();
            });
        if (folder is not null)
        {
            CompareFiles.Write(folder, runs);
        }

        if (json)
        {
            CompareJson.Write(console.Output, runs);
        }
        else
        {
            CompareTables.Write(console, runs, folder);
        }

        return ExitCodeOf(runs);
    }

    /// <summary>
    /// Runs something small with each strategy first, so that JIT compilation is not counted as time of heals.
    /// </summary>
    private static void WarmUp(CompareOptions[] options, Action<double> progress)
    {
        Scene small = BuiltInScenes.Pair();
        foreach (string strategy in options.Select(run => run.Strategy).Distinct())
        {
            CompareTest.Run(new CompareOptions(small, PlayerPlan.Draw(small, 2, 1), strategy, LinkProfiles.Awful) { Peers = 2, Cancellation = options[0].Cancellation }, _ => progress(0));
        }
    }

    private static LinkProfile[] Links(string profile) =>
        profile == All ? [.. LinkProfiles.All]
        : LinkProfiles.TryGet(profile, out LinkProfile? found, out string? error) ? [found]
        : throw new UsageException(error);
}
