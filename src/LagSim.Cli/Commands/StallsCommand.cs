using System;
using System.Collections.Generic;
using System.CommandLine;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Harness.Verification.Stalls;

namespace LagSim.Cli.Commands;

/// <summary>
/// <c>lagsim stalls</c>: random sessions in which peers stall, are killed and restarted, and change address.
/// </summary>
internal static class StallsCommand
{
    /// <summary>A session has up to seven processes, which are idle most of the time.</summary>
    private const int ProcessSessionsAtOnce = 4;

    /// <param name="console">The console to write to.</param>
    /// <param name="change">For tests: injects a fault.</param>
    /// <param name="tool">For tests: the program to start for each process; null for this one.</param>
    internal static Command Create(ToolConsole console, Func<StallOptions, StallOptions>? change = null, string[]? tool = null)
    {
        CommonOptions common = new();
        Option<int> sessions = CommonOptions.Whole(
            "--sessions", "How many sessions to draw; the first takes the given seed, and each further one the next", 200, 1, 1_000_000);
        Option<int> worst = CommonOptions.Whole(
            "--worst", "How many of them to list one by one, beginning with those that took longest to recover", 20, 0, 1_000);
        Option<int> processes = CommonOptions.Whole(
            "--processes", "How many of the worst to play again with real processes, using SIGSTOP, kill -9 and a relay that changes ports; each takes minutes", 0, 0, 1_000);
        Command command = new(
            "stalls",
            "Plays randomly drawn sessions, in virtual time, in which the host or clients freeze for 1 to 60 s, are killed and restarted, or change"
                + " ports every 10 s."
                + " Exits with 0 if play goes on in all of them: no accepted event is lost, no state differs, every client that was away comes back without"
                + " help as the same player, and no other is interrupted.") { sessions, worst, processes };
        common.AddSeedAndJsonTo(command);
        command.SetAction(parsed =>
        {
            StallOptions options = new() { Sessions = parsed.GetValue(sessions), Seed = parsed.GetValue(common.Seed) };
            int again = parsed.GetValue(processes);
            if (again > 0 && OperatingSystem.IsWindows())
            {
                throw new UsageException(
                    $"--processes is '{again}'; processes are stopped by signals, which this system does not have: it takes 0 here.");
            }

            if (again > options.Sessions)
            {
                throw new UsageException(FormattableString.Invariant($"--processes is '{again}'; of {options.Sessions} sessions it takes 0 to {options.Sessions}."));
            }

            return Run(console, change?.Invoke(options) ?? options, parsed.GetValue(worst), again, tool, parsed.GetValue(common.Json));
        });
        return command;
    }

    private static int Run(ToolConsole console, StallOptions options, int worst, int again, string[]? tool, bool json)
    {
        int done = 0;
        IReadOnlyList<StallOutcome> outcomes = console.WithProgress(
            "sessions with stalls, virtual time",
            options.Sessions,
            progress => StallTest.Run(
                options,
                outcome =>
                {
                    if (++done % 100 == 0 || !outcome.IsGood)
                    {
                        string how = outcome.IsGood ? "" : FormattableString.Invariant($"; seed {outcome.Case.Seed} is not good");
                        console.Begin(FormattableString.Invariant($"{done} of {options.Sessions} sessions{how}"));
                    }

                    progress(done);
                },
                console.Stop));
        StallOutcome[] ranked = [.. outcomes.OrderBy(o => o.IsGood).ThenByDescending(o => o.WorstSeconds).ThenBy(o => o.Case.Seed)];
        IReadOnlyList<StallProcessOutcome> played = again == 0 || outcomes.Count < options.Sessions ? [] : PlayAgain(console, [.. ranked.Take(again)], tool ?? ThisTool());
        bool isStopped = outcomes.Count < options.Sessions || played.Count < again;
        if (json)
        {
            StallsJson.Write(console.Output, options, outcomes, [.. ranked.Take(worst)], played, isStopped);
        }
        else
        {
            StallsText.Write(console.Output, outcomes, [.. ranked.Take(worst)], played);
            if (isStopped)
            {
                console.Output.WriteLine(FormattableString.Invariant(
                    $"stopped early: {outcomes.Count} of {options.Sessions} sessions played, and {played.Count} of {again} with processes"));
            }
        }

        return outcomes.All(o => o.IsGood) && played.All(o => o.IsGood)
            ? console.Stop.IsCancellationRequested ? ExitCode.Interrupted : ExitCode.Done
            : ExitCode.CheckFailed;
    }

    /// <summary>
    /// Returns the total duration of all sessions, in seconds, with a number of workers that each take the next session when done.
    /// </summary>
    internal static double SecondsOfAll(IEnumerable<double> each, int workers)
    {
        double[] busyUntil = new double[workers];
        foreach (double seconds in each)
        {
            busyUntil[Array.IndexOf(busyUntil, busyUntil.Min())] += seconds;
        }

        return busyUntil.Max();
    }

    /// <summary>
    /// Plays sessions with processes. Reports which session begins, what happens in it and its progress on the error stream.
    /// </summary>
    private static IReadOnlyList<StallProcessOutcome> PlayAgain(ToolConsole console, StallOutcome[] chosen, string[] tool)
    {
        double[] lengths = [.. chosen.Select(o => StallProcessRun.SecondsOf(o.Case, o.WorstSeconds))];
        int workers = Math.Min(ProcessSessionsAtOnce, chosen.Length);
        string title = string.Create(
            CultureInfo.InvariantCulture,
            $"{NumberText.Count(chosen.Length, "session")} again with processes, {workers} at a time, in about {SecondsOfAll(lengths, workers):0} s");
        return console.WithProgress(title, lengths.Sum(), progress =>
        {
            StallProcessOutcome?[] outcomes = new StallProcessOutcome?[chosen.Length];
            double[] played = new double[chosen.Length];
            object gate = new();
            int next = -1;
            int done = 0;
            Task.WaitAll([.. Enumerable.Range(0, workers).Select(_ => Task.Factory.StartNew(Work, TaskCreationOptions.LongRunning))]);
            return outcomes.OfType<StallProcessOutcome>().ToArray();

            void Work()
            {
                while (!console.Stop.IsCancellationRequested && Interlocked.Increment(ref next) is int n && n < chosen.Length)
                {
                    string folder = Directory.CreateTempSubdirectory("lagsim-stalls-").FullName;
                    try
                    {
                        Tell(n, 0, string.Create(CultureInfo.InvariantCulture, $"begins, and takes about {lengths[n]:0} s: {chosen[n].Case}"));
                        using StallProcessRun run = new(
                            chosen[n].Case, chosen[n].WorstSeconds, tool, folder, console.Stop,
                            (seconds, what) => Tell(n, seconds, what is null ? null : string.Create(CultureInfo.InvariantCulture, $"{seconds:0} of {lengths[n]:0} s: {what}")));
                        outcomes[n] = run.Play();
                    }
                    catch (OperationCanceledException) when (console.Stop.IsCancellationRequested)
                    {
                        return;
                    }
                    finally
                    {
                        Directory.Delete(folder, recursive: true);
                    }

                    StallProcessOutcome outcome = outcomes[n]!;
                    string how = outcome.IsGood ? "good" : $"not good: {string.Join(" ", outcome.Failures)}";
                    Tell(n, lengths[n], string.Create(CultureInfo.InvariantCulture, $"{how} ({Interlocked.Increment(ref done)} of {chosen.Length} done)"));
                }
            }

            void Tell(int n, double seconds, string? what)
            {
                lock (gate)
                {
                    if (what is not null)
                    {
                        console.Begin(string.Create(CultureInfo.InvariantCulture, $"seed {chosen[n].Case.Seed}: {what}"));
                    }

                    played[n] = seconds;
                    progress(played.Sum());
                }
            }
        });
    }

    /// <summary>Returns the command that starts this program: its own executable, or the runtime's host.</summary>
    internal static string[] ThisTool()
    {
        string program = Environment.ProcessPath ?? throw new InputException("--processes needs to know where this program is, and the system does not say.");
        return Path.GetFileNameWithoutExtension(program) == "dotnet" ? [program, typeof(StallsCommand).Assembly.Location] : [program];
    }
}
