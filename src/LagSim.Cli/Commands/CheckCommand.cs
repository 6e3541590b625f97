using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Verification.Check;
using LagSim.Harness.Verification.Worlds;
using LagSim.Net.Strategies;
using LagSim.Testing.Links;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim check</c>: random sessions against the one invariant.</summary>
internal static class CheckCommand
{
    private const string All = "all";
    private const string None = "none";

    /// <param name="console">The console that the report is written to.</param>
    /// <param name="change">Changes the options, for tests that inject faults; null changes nothing.</param>
    internal static Command Create(ToolConsole console, Func<CheckOptions, CheckOptions>? change = null)
    {
        CommonOptions common = new();
        Option<int> sessions = CommonOptions.Whole("--sessions", "How many sessions; each takes the next seed", 1000, 1, 10_000_000);
        Option<int?> worlds = new("--worlds")
        {
            Description = "How many single worlds to play too, without a network: late, shuffled, doubled and retracted events, and promises about their"
                + " physics. Without --sessions no session is played.",
            HelpName = "N",
            CustomParser = result => CommonOptions.ParseWhole(result, "--worlds", 1, 10_000_000),
        };
        Option<string> peers = new("--peers")
        {
            Description = $"How many peers a session has, the host included: a number, or a range ({CheckOptions.FewestPeers} to {CheckOptions.MaxPeers}).",
            HelpName = "N|N-M",
            DefaultValueFactory = _ => $"{CheckOptions.FewestPeers}-{CheckOptions.MaxPeers}",
        };
        Option<string> profile = new("--profile")
        {
            Description = $"The link between each client and the host: {string.Join(", ", LinkProfiles.All.Select(p => p.Name))},"
                + $" {LinkProfiles.AnyDelay};"
                + $" or {All}: a different one for each client.",
            HelpName = "NAME",
            DefaultValueFactory = _ => All,
        };
        Option<string> strategy = CommonOptions.Word("--strategy", "What a peer does with an event that arrives late.", LateEventStrategies.Default, [.. LateEventStrategies.Names]);
        Option<string?> bodies = new("--bodies") { Description = "For a single session: the numbers of the bodies of its scene that take part.", HelpName = "N,N,..." };
        Option<string?> events = new("--events") { Description = $"For a single session: the numbers of the drawn events that are done, or {None}.", HelpName = "N,N,..." };
        Option<string> rules = CommonOptions.Word("--rules", "Which sessions have rules of a game, drawn too: 15 in a hundred, all or none.", "some", ["some", "all", "none"]);
        Command command = new("check", "Plays random seeded sessions and compares every peer with one that never had any delay; a failing seed is shrunk to a smaller case"
            + " that can be replayed.")
        {
            sessions, worlds, peers, profile, strategy, rules, bodies, events,
        };
        common.AddTo(command);
        command.SetAction(parsed =>
        {
            (int from, int to) = Peers(parsed.GetValue(peers)!);
            int? single = parsed.GetValue(worlds);
            bool isOfWorldsAlone = single is not null && parsed.GetResult(sessions)?.Implicit != false;
            CheckOptions options = new()
            {
                Sessions = parsed.GetValue(sessions),
                Seed = parsed.GetValue(common.Seed),
                FromPeers = from,
                ToPeers = to,
                Profile = Profile(parsed.GetValue(profile)!),
                Strategy = parsed.GetValue(strategy)!,
                Rules = parsed.GetValue(rules) switch { "all" => RulesOfSessions.All, "none" => RulesOfSessions.None, _ => RulesOfSessions.Some },
                Bodies = Indices("--bodies", parsed.GetValue(bodies)),
                Events = Indices("--events", parsed.GetValue(events)),
            };
            if (isOfWorldsAlone && (options.Bodies ?? options.Events) is not null)
            {
                throw new UsageException("--bodies and --events are of a session: leave out --worlds.");
            }

            if (options.Sessions > 1 && !isOfWorldsAlone && (options.Bodies ?? options.Events) is not null)
            {
                throw new UsageException($"--bodies and --events are of one session alone: give its --seed, and --sessions 1 instead of {options.Sessions}.");
            }

            WorldOptions? ofWorlds = single is int number ? new WorldOptions { Worlds = number, Seed = options.Seed } : null;
            return Run(
                console, change?.Invoke(options) ?? options, isOfWorldsAlone, ofWorlds, parsed.GetValue(common.Out), parsed.GetValue(common.Json));
        });
        return command;
    }

    private static int Run(ToolConsole console, CheckOptions options, bool isOfWorldsAlone, WorldOptions? ofWorlds, string? folder, bool json)
    {
        if (folder is not null)
        {
            OutputFolder.ThrowIfNotWritable(folder);
        }

        CheckReport report;
        try
        {
            report = isOfWorldsAlone
                ? new CheckReport([], [], 0, 0)
                : console.WithProgress("check", options.Sessions, progress => InvariantCheck.Run(options, done => progress(done), console.Stop));
        }
        catch (ArgumentException mistake)
        {
            throw new UsageException(Sentence.Of(mistake)); // numbers that the session does not have
        }

        WorldReport? worlds = ofWorlds is null || console.Stop.IsCancellationRequested
            ? null
            : console.WithProgress("worlds", ofWorlds.Worlds, progress => WorldCheck.Run(ofWorlds, done => progress(done), console.Stop));
        if (folder is not null)
        {
            CheckFiles.Write(folder, options, report);
        }

        if (json)
        {
            CheckJson.Write(console.Output, options, report, worlds);
        }
        else
        {
            if (!isOfWorldsAlone)
            {
                CheckText.Write(console.Output, options, report, folder);
            }

            WorldText.Write(console.Output, ofWorlds, worlds);
        }

        return report.Failures.Count > 0 || worlds?.Failures.Count > 0 ? ExitCode.CheckFailed
            : console.Stop.IsCancellationRequested ? ExitCode.Interrupted
            : ExitCode.Done;
    }

    private static (int From, int To) Peers(string text)
    {
        string[] parts = text.Split('-');
        int[] numbers = [.. parts.Select(part => int.TryParse(part, NumberStyles.None, CultureInfo.InvariantCulture, out int number) ? number : -1)];
        return parts.Length <= 2 && numbers[0] >= CheckOptions.FewestPeers && numbers[^1] <= CheckOptions.MaxPeers && numbers[0] <= numbers[^1]
            ? (numbers[0], numbers[^1])
            : throw new UsageException($"--peers is '{text}'; it must be a number from {CheckOptions.FewestPeers} to {CheckOptions.MaxPeers}, or a range of"
                + " them such as 2-8.");
    }

    private static LinkProfile? Profile(string name) =>
        name == All ? null : LinkProfiles.TryGet(name, out LinkProfile? found, out string? error) ? found : throw new UsageException(error);

    private static IReadOnlyList<int>? Indices(string option, string? text)
    {
        if (text is null || text == None)
        {
            return text is null ? null : [];
        }

        int[] numbers = [.. text.Split(',').Select(part => int.TryParse(part, NumberStyles.None, CultureInfo.InvariantCulture, out int number) ? number : -1)];
        return Array.IndexOf(numbers, -1) < 0
            ? numbers
            : throw new UsageException($"{option} is '{text}'; it must be whole numbers with commas between them, such as 0,3.");
    }
}
