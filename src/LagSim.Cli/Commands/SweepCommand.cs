using System;
using System.Collections.Generic;
using System.CommandLine;
using System.CommandLine.Parsing;
using System.Globalization;
using System.Linq;
using LagSim.Cli.Output;
using LagSim.Harness.Experiments.Sweep;

namespace LagSim.Cli.Commands;

/// <summary><c>lagsim sweep</c>: sessions on links that are full, or nearly full.</summary>
internal static class SweepCommand
{
    internal static Command Create(ToolConsole console)
    {
        CommonOptions common = new();
        SweepOptions byDefault = new();
        Option<double[]> clients = Numbers("--clients", "How many clients, each with a link of its own", byDefault.Clients.Select(n => (double)n), 1, 8);
        Option<double[]> events = Numbers("--events", "How many events each client does a second", byDefault.EventsPerSecond, 0, 200);
        Option<double[]> rates = Numbers("--rate-kbps", "What each link carries in each direction, in kbit/s", byDefault.KilobitsPerSecond, 16, 1_000_000);
        Option<double[]> queues = Numbers("--queue-ms", "How long each link's queues are, in milliseconds at that rate", byDefault.QueueMilliseconds, 0, 10_000);
        Option<bool> noDips = new("--no-dips") { Description = "Only links of a constant rate; otherwise each cell is also played with dips to a fifth of the rate for 5 s every 30 s." };
        Option<bool> shared = new("--shared") { Description = "All clients share one link of that rate; otherwise each has a link of its own." };
        Option<bool> bulk = new("--bulk") { Description = "Adds a bulk TCP transfer to each client through the same queues." };
        Option<double> play = CommonOptions.Number("--play-s", "How long players do things, in seconds", byDefault.PlaySeconds, 1, 3600);
        Option<double> rest = CommonOptions.Number("--rest-s", "How long everyone then rests, in seconds", byDefault.RestSeconds, 1, 3600);
        Option<string?> beside = new("--beside") { Description = "The output of lagsim sweep --json from another run: --out draws it dashed beside this one.", HelpName = "FILE" };
        Command command = new(
            "sweep",
            "Plays sessions over links that are full or nearly full, in virtual time, and reports offered and delivered load, round trips, refusals, and whether"
                + " all peers agree. Exits with 0 if every cell passes: no accepted event lost, no state that differs, and at least 90 % of the host's states"
                + " compared by each client.") { clients, events, rates, queues, noDips, shared, bulk, play, rest, beside };
        common.AddTo(command);
        command.SetAction(parsed =>
        {
            SweepOptions options = new()
            {
                Clients = [.. Given(parsed, clients, byDefault.Clients.Select(n => (double)n)).Select(n => n == Math.Floor(n) ? (int)n : throw new UsageException($"--clients is {n}; it takes whole numbers from 1 to 8."))],
                EventsPerSecond = Given(parsed, events, byDefault.EventsPerSecond),
                KilobitsPerSecond = Given(parsed, rates, byDefault.KilobitsPerSecond),
                QueueMilliseconds = Given(parsed, queues, byDefault.QueueMilliseconds),
                Dips = !parsed.GetValue(noDips),
                IsShared = parsed.GetValue(shared),
                BulkTransfers = parsed.GetValue(bulk),
                PlaySeconds = parsed.GetValue(play),
                RestSeconds = parsed.GetValue(rest),
                Seed = parsed.GetValue(common.Seed),
            };
            string? folder = parsed.GetValue(common.Out), other = parsed.GetValue(beside);
            if (other is not null && folder is null)
            {
                throw new UsageException($"--beside is '{other}', and is for the charts of --out, which is missing.");
            }

            return Run(console, options, folder, other is null ? null : SweepReader.Read(other), parsed.GetValue(common.Json));
        });
        return command;
    }

    private static int Run(ToolConsole console, SweepOptions options, string? folder, IReadOnlyList<SweepOutcome>? beside, bool json)
    {
        if (folder is not null)
        {
            OutputFolder.ThrowIfNotWritable(folder); // report this before minutes of work
        }

        int count = options.Cells().Count();
        int done = 0;
        IReadOnlyList<SweepOutcome> outcomes = console.WithProgress(
            "sweep over full links, virtual time",
            count,
            progress => LinkSweep.Run(
                options,
                outcome =>
                {
                    console.Begin(outcome.Cell.ToString());
                    progress(++done);
                },
                console.Stop));
        bool isStopped = outcomes.Count < count;
        if (outcomes.Count == 0)
        {
            console.Stop.ThrowIfCancellationRequested(); // nothing to report
        }

        if (folder is not null && outcomes.Count > 0)
        {
            SweepFiles.Write(folder, options, outcomes, beside);
        }

        if (json)
        {
            SweepJson.Write(console.Output, options, outcomes, isStopped);
        }
        else
        {
            SweepTables.Write(console, outcomes, folder, count);
        }

        return !outcomes.All(outcome => outcome.IsGood) ? ExitCode.CheckFailed : isStopped ? ExitCode.Interrupted : ExitCode.Done;
    }

    /// <summary>Returns the given numbers, or the default.</summary>
    private static IReadOnlyList<double> Given(ParseResult parsed, Option<double[]> option, IEnumerable<double> byDefault) =>
        parsed.GetResult(option) is null ? [.. byDefault] : parsed.GetValue(option)!;

    /// <summary>An option with comma-separated numbers.</summary>
    /// <remarks>The default is in the description, since the parser would print it as <c>3|8</c>.</remarks>
    private static Option<double[]> Numbers(string name, string description, IEnumerable<double> byDefault, double least, double most)
    {
        string text = string.Join(",", byDefault.Select(n => n.ToString("0.###", CultureInfo.InvariantCulture)));
        return new Option<double[]>(name)
        {
            Description = FormattableString.Invariant($"{description}: comma-separated numbers from {least} to {most}; default {text}."),
            HelpName = "N,N",
            CustomParser = result => Parse(result, name, least, most),
        };
    }

    private static double[] Parse(ArgumentResult result, string name, double least, double most)
    {
        string text = result.Tokens.Count == 1 ? result.Tokens[0].Value : "";
        List<double> numbers = [];
        foreach (string part in text.Split(','))
        {
            if (!double.TryParse(part, NumberStyles.Float, CultureInfo.InvariantCulture, out double number) || !(number >= least && number <= most))
            {
                result.AddError(FormattableString.Invariant($"{name} is '{part}' in '{text}'; it takes comma-separated numbers from {least} to {most}."));
                return [];
            }

            numbers.Add(number);
        }

        return [.. numbers];
    }
}
