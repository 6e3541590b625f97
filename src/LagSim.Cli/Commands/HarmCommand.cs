using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Harm;
using LagSim.Net.Sessions;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim harm</c>: random attacks by one player on the other players' worlds, and the cost of honest players.</summary>
internal static class HarmCommand
{
    private const double HonestSeconds = 30;

    /// <param name="console">The console to write to.</param>
    /// <param name="tool">For tests: the program to start for each process; null for this one.</param>
    internal static Command Create(ToolConsole console, string[]? tool = null)
    {
        CommonOptions common = new();
        Option<int> attacks = CommonOptions.Whole(
            "--attacks", "How many attacks to draw; the first takes the given seed, and each further one the next", 200, 0, 1_000_000);
        Option<int> worst = CommonOptions.Whole("--worst", "How many of them to list one by one, beginning with those that made worlds the latest", 20, 0, 1_000);
        Option<int> processes = CommonOptions.Whole("--processes", "How many of the worst to play again with real processes, each in about 15 s", 0, 0, 1_000);
        Option<double> share = CommonOptions.Number(
            "--budget", "The host's budget for each player, as a multiple of the default; 0 for none, to see what the attacks do then", 1, 0, 1000);
        Option<double> machine = CommonOptions.Number(
            "--machine", "How fast the machines are, as a multiple of one core that does 1,000,000 units of work a second", 1, 0.01, 1000);
        Option<bool> honest = new("--honest") { Description = "Also play every built-in scene with players who mean no harm, and list how far they stay from their budgets." };
        Option<int> starved = CommonOptions.Whole(
            "--starved",
            "How many sessions of honest players to draw and play with real processes against a host that gets little time: a tenth of a core, half of one, or what 16 spinning programs leave. Each takes some 10 s; not on Windows",
            0,
            0,
            100_000);
        Command command = new(
            "harm",
            "Has one player attack the others' worlds in randomly drawn ways, all within a host's other limits: fast balls in narrow gaps, heaps, hands that shake"
                + " them, storms of events. In virtual time, on machines that take as long as the work that they do. Exits with 0 if in all of them the others' worlds stay within 250 ms of real"
                + " time, or the player is out within 2 s and they are back within 2 s more.") { attacks, worst, processes, share, machine, honest, starved };
        common.AddSeedAndJsonTo(command);
        command.SetAction(parsed =>
        {
            HarmOptions options = new()
            {
                Attacks = parsed.GetValue(attacks),
                Seed = parsed.GetValue(common.Seed),
                Budget = Budget(parsed.GetValue(share)),
                WorkPerSecond = parsed.GetValue(machine) * 1e6,
            };
            int again = parsed.GetValue(processes);
            if (again > options.Attacks)
            {
                throw new UsageException(FormattableString.Invariant($"--processes is '{again}'; of {options.Attacks} attacks it takes 0 to {options.Attacks}."));
            }

            if (parsed.GetValue(honest) && options.Budget is null)
            {
                throw new UsageException("--honest tells how far players stay from their budgets; with --budget 0 they have none.");
            }

            if (parsed.GetValue(starved) > 0 && OperatingSystem.IsWindows())
            {
                throw new UsageException("--starved stops and continues a process by signals, which Windows does not have; it can be played on Linux and macOS.");
            }

            return Run(console, options, parsed.GetValue(worst), again, parsed.GetValue(honest), (parsed.GetValue(starved), parsed.GetValue(share)), tool, parsed.GetValue(common.Json));
        });
        return command;
    }

    /// <summary>A multiple of the default budget; 0 for no budget.</summary>
    internal static PlayerBudget? Budget(double times) =>
        times == 0 ? null : new PlayerBudget(Math.Max(1, PlayerBudget.Default.WorkPerSecond * times), Math.Max(1, PlayerBudget.Default.WorkAtOnce * times));

    private static int Run(ToolConsole console, HarmOptions options, int worst, int again, bool honest, (int Count, double Budget) starved, string[]? tool, bool json)
    {
        int done = 0;
        IReadOnlyList<HarmOutcome> outcomes = options.Attacks == 0 ? [] : console.WithProgress(
            "attacks, virtual time",
            options.Attacks,
            progress => HarmTest.Run(
                options,
                outcome =>
                {
                    if (++done % 100 == 0 || !outcome.IsGood)
                    {
                        string how = outcome.IsGood ? "" : FormattableString.Invariant($"; seed {outcome.Case.Seed} is not good");
                        console.Begin(FormattableString.Invariant($"{done} of {options.Attacks} attacks{how}"));
                    }

                    progress(done);
                },
                console.Stop));
        HarmOutcome[] ranked = [.. outcomes.OrderBy(o => o.IsGood).ThenByDescending(o => o.LateSeconds).ThenBy(o => o.Case.Seed)];
        HarmOutcome[] toReplay = outcomes.Count < options.Attacks ? []
            : [.. ranked.Where(o => o.Case.Scene.Rules is null).Take(again)]; // the tool has no rules
        IReadOnlyList<HarmProcessOutcome> played = toReplay.Length == 0 ? [] : PlayAgain(console, toReplay, tool ?? StallsCommand.ThisTool());
        IReadOnlyList<HonestCost> costs = honest ? PlayHonest(console, options) : [];
        IReadOnlyList<StarvedOutcome> hungry = starved.Count > 0 ? PlayStarved(console, options.Seed, starved, tool ?? StallsCommand.ThisTool()) : [];
        bool isStopped = hungry.Count < starved.Count || outcomes.Count < options.Attacks || played.Count < toReplay.Length || (honest && costs.Count < HonestPlay.Scenes.Count);
        if (json)
        {
            HarmJson.Write(console.Output, options, outcomes, [.. ranked.Take(worst)], played, costs, hungry, isStopped);
        }
        else
        {
            HarmText.Write(console.Output, outcomes, [.. ranked.Take(worst)], played, costs, hungry);
            if (isStopped)
            {
                console.Output.WriteLine(FormattableString.Invariant(
                    $"stopped early: {outcomes.Count} of {options.Attacks} attacks played, and {played.Count} of {again} with processes"));
            }
        }

        return outcomes.All(o => o.IsGood) && played.All(o => o.IsGood) && costs.All(c => c.Expelled == 0) && hungry.All(o => o.IsGood)
            ? console.Stop.IsCancellationRequested ? ExitCode.Interrupted : ExitCode.Done
            : ExitCode.CheckFailed;
    }

    private static IReadOnlyList<HonestCost> PlayHonest(ToolConsole console, HarmOptions options) => console.WithProgress(
        "scenes with honest players, virtual time",
        HonestPlay.Scenes.Count,
        progress =>
        {
            List<HonestCost> costs = [];
            try
            {
                foreach (string scene in HonestPlay.Scenes)
                {
                    costs.Add(HonestPlay.Play(scene, options.Seed, HonestSeconds, options.Budget!, console.Stop));
                    progress(costs.Count);
                }
            }
            catch (OperationCanceledException) when (console.Stop.IsCancellationRequested)
            {
                // what was played so far is reported
            }

            return costs;
        });

    /// <summary>One after the other, since each is to get as little time as it says.</summary>
    private static IReadOnlyList<StarvedOutcome> PlayStarved(ToolConsole console, ulong seed, (int Count, double Budget) asked, string[] tool) => console.WithProgress(
        "sessions of honest players with a starved host",
        asked.Count,
        progress =>
        {
            List<StarvedOutcome> played = [];
            while (played.Count < asked.Count)
            {
                StarvedCase drawn = new(seed + (ulong)played.Count);
                try
                {
                    using StarvedRun run = new(drawn, asked.Budget, tool, console.Stop);
                    played.Add(run.Play());
                }
                catch (OperationCanceledException) when (console.Stop.IsCancellationRequested)
                {
                    break;
                }

                progress(played.Count);
            }

            return played;
        });

    /// <summary>One after the other, since this measures the machine's speed.</summary>
    private static IReadOnlyList<HarmProcessOutcome> PlayAgain(ToolConsole console, HarmOutcome[] chosen, string[] tool) => console.WithProgress(
        string.Create(CultureInfo.InvariantCulture, $"{NumberText.Count(chosen.Length, "attack")} again with processes, in about {chosen.Length * HarmProcessRun.PlaySeconds * 1.2:0} s"),
        chosen.Length,
        progress =>
        {
            List<HarmProcessOutcome> played = [];
            foreach (HarmOutcome outcome in chosen)
            {
                string folder = Directory.CreateTempSubdirectory("lagsim-harm-").FullName;
                try
                {
                    console.Begin(string.Create(CultureInfo.InvariantCulture, $"seed {outcome.Case.Seed}: {outcome.Case}"));
                    using HarmProcessRun run = new(outcome.Case, tool, folder, console.Stop);
                    played.Add(run.Play());
                }
                catch (OperationCanceledException) when (console.Stop.IsCancellationRequested)
                {
                    break;
                }
                finally
                {
                    Directory.Delete(folder, recursive: true);
                }

                progress(played.Count);
            }

            return played;
        });
}
