using System.Collections.Generic;
using System.CommandLine;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Drop;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim drop</c>: the thesis's drop test.</summary>
internal static class DropCommand
{
    private const string All = "all";
    private const double DefaultDelay = 25;

    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        Option<string> which = CommonOptions.Word("--case", "Which half of the test to run: both sides start equal (Fig 2), or one side lifts its ball (Fig 3).", All, "same-start", "teleport", All);
        Option<string> strategy = CommonOptions.Word("--strategy", "What a peer does with an event that arrives late.", LateEventStrategies.Default, [.. LateEventStrategies.Names, All]);
        Option<double> displayDelay = CommonOptions.DisplayDelay();
        Option<string> motion = CommonOptions.Word("--motion", "How the ball flies: integrated in steps as in the thesis, or in closed form.", "rk4", "rk4", "ballistic");
        Option<double> rate = CommonOptions.Number("--rate-hz", "Steps per second of rk4; ballistic motion has none", 200, 1, 1e4);
        Option<double?> delay = CommonOptions.Delay("default 25");
        Option<string?> profile = CommonOptions.Profile();
        Option<int> peers = CommonOptions.Whole("--peers", "How many peers, the host included", 2, 2, 9);
        Option<string> time = CommonOptions.Time("real");
        Option<string> transport = CommonOptions.Word("--transport", "What carries the datagrams in real time; in virtual time they only cross the simulated"
            + " link.", Carrier.Udp.Name, CarrierChoice.Names);
        Option<bool> unprotected = ProtectionOptions.UnprotectedExperiment();
        Option<double> height = CommonOptions.Number("--height-m", "The height from which the ball's centre falls", 10, 0.5, 1e6);
        Option<double> second = CommonOptions.Number("--second-height-m", "The height to which it is lifted", 15, 0.5, 1e6);
        Option<double> restitution = CommonOptions.Number("--restitution", "Restitution of ball and floor", 0.8, 0, 1);

        Command command = new("drop", "The thesis's drop test: two instances of a world, a ball that falls, and one side that lifts it.")
        {
            which, strategy, displayDelay, motion, rate, delay, profile, peers, time, transport, unprotected, height, second, restitution,
        };
        common.AddTo(command);
        command.SetAction(parsed =>
        {
            LinkProfile? asked = CommonOptions.LinkOf(parsed.GetValue(delay), parsed.GetValue(profile));
            string chosen = parsed.GetValue(strategy)!;
            DropOptions options = new()
            {
                Cases = Cases(parsed.GetValue(which)!),
                Strategy = chosen == All ? LateEventStrategies.Default : chosen,
                DisplayDelay = SimDuration.FromMilliseconds(parsed.GetValue(displayDelay)),
                Motion = parsed.GetValue(motion) == "rk4" ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic,
                RateHertz = parsed.GetValue(rate),
                Link = asked ?? LinkProfiles.PureDelay(DefaultDelay),
                DelayMilliseconds = parsed.GetValue(profile) is null ? parsed.GetValue(delay) ?? DefaultDelay : null,
                Peers = parsed.GetValue(peers),
                IsVirtual = parsed.GetValue(time) == "virtual",
                Carrier = CarrierChoice.Of(parsed.GetValue(transport)!) with { IsProtected = !parsed.GetValue(unprotected) },
                HeightMetres = parsed.GetValue(height),
                SecondHeightMetres = parsed.GetValue(second),
                Restitution = parsed.GetValue(restitution),
                Seed = parsed.GetValue(common.Seed),
                Cancellation = console.Stop,
            };
            return Run(console, options, chosen == All, parsed.GetValue(common.Out), parsed.GetValue(common.Json));
        });
        return command;
    }

    private static int Run(ToolConsole console, DropOptions options, bool allStrategies, string? folder, bool json)
    {
        if (folder is not null)
        {
            OutputFolder.ThrowIfNotWritable(folder); // report this before half a minute of work
        }

        string title = options.IsVirtual
            ? "drop, virtual time"
            : $"drop, {options.Length.ToSeconds():0} s in real time over {options.Carrier}";
        IReadOnlyList<DropRun> runs = console.WithProgress(
            title, options.Length.ToSeconds(), progress => DropTest.Run(options, done => progress(done.ToSeconds())));

        // The comparison of all strategies uses the lift only, so it is left out where only the other half is asked for.
        List<DropRun> strategies = allStrategies || options.Cases.Contains(DropCase.Teleport) ? CompareStrategies(console, options) : [];
        List<DropRun> reported = [.. runs, .. allStrategies ? strategies : []];
        if (folder is not null)
        {
            DropFiles.Write(folder, runs, strategies);
        }

        if (json)
        {
            DropJson.Write(console.Output, options, reported);
        }
        else
        {
            DropTables.Write(console, options, runs, strategies, folder);
        }

        return ExitCodeOf(runs.Concat(strategies));
    }

    private static List<DropRun> CompareStrategies(ToolConsole console, DropOptions options)
    {
        IReadOnlyList<DropOptions> compared = options.ForEveryStrategy();
        double each = compared[0].Length.ToSeconds();
        return console.WithProgress(
            "every strategy, virtual time",
            each * compared.Count,
            progress => compared.Select((other, n) =>
            {
                console.Begin(other.Strategy);
                return DropTest.Run(other, done => progress((n * each) + done.ToSeconds()))[0];
            }).ToList());
    }

    /// <summary>Checks that strategies that promise agreement agree, in the comparison too.</summary>
    internal static int ExitCodeOf(IEnumerable<DropRun> runs) =>
        runs.Any(run => LateEventStrategies.Create(run.Options.Strategy).PromisesAgreement && !run.Agrees) ? ExitCode.CheckFailed : ExitCode.Done;

    private static IReadOnlyList<DropCase> Cases(string which) => which switch
    {
        "same-start" => [DropCase.SameStart],
        "teleport" => [DropCase.Teleport],
        _ => [DropCase.SameStart, DropCase.Teleport],
    };
}
