using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using System.Text.Json;
using System.Threading;
using LagSim.Harness.Verification.Stalls;

namespace LagSim.Harness.Verification.Harm;

/// <summary>
/// Plays honest players with real processes against a host that gets little time: it is stopped and continued ten times a second, or shares
/// its cores with programs that spin.
/// </summary>
/// <remarks>For Unix: it takes a shell, and the signals by which a process is stopped.</remarks>
/// <param name="drawn">The session.</param>
/// <param name="budget">The host's budget for each player, as a multiple of the default; 0 for none.</param>
/// <param name="tool">The tool's program, and the arguments that it needs before its own.</param>
/// <param name="cancellation">Ends it early.</param>
public sealed class StarvedRun(StarvedCase drawn, double budget, IReadOnlyList<string> tool, CancellationToken cancellation) : IDisposable
{
    private const double StartSeconds = 120;
    private const double PeriodSeconds = 0.1;

    private readonly List<StallProcess> all = [];
    private readonly List<Process> others = [];

    /// <summary>Plays it, in about <see cref="StarvedCase.Seconds"/> and the time that five processes take to start.</summary>
    public StarvedOutcome Play()
    {
        StallProcess host = Run("host", "--scene", drawn.SceneName, "--joiners", Text(StarvedCase.Players), "--budget", Text(budget), "--for-s", Text(StarvedCase.From + StarvedCase.Seconds + 1), "--json");
        if (host.Await("listening on ", StartSeconds, cancellation) is not string address)
        {
            return new StarvedOutcome(drawn, 0, 0, [$"The host does not listen: {Last(host)}"]);
        }

        StallProcess[] players = [.. drawn.Actions.Select(actions => Run(["join", address, "--json", .. actions.SelectMany(action => new[] { "--do", action })]))];
        for (int n = 1; n <= players.Length; n++)
        {
            if (host.Await(string.Create(CultureInfo.InvariantCulture, $"peer {n} at"), StartSeconds, cancellation) is null)
            {
                return new StarvedOutcome(drawn, 0, 0, [$"Not all came in: {Last(host)} {string.Join(" ", players.Select(Last))}"]);
            }
        }

        Starve(host);
        List<string> failures = [];
        if (!host.AwaitEnd((StarvedCase.Seconds / drawn.Share * 4) + StartSeconds, cancellation))
        {
            failures.Add($"The host did not end in time: {Last(host)}");
        }

        StopStarving();
        foreach (StallProcess player in players.Where(player => !player.AwaitEnd(20, cancellation)))
        {
            failures.Add($"A player did not end with the host: {Last(player)}");
            player.Kill();
        }

        failures.AddRange(host.Lines.Where(line => line.Contains("is disconnected", StringComparison.Ordinal)));
        failures.AddRange(players.Where(player => EndOf(player) != "host-ended").Select(player => $"A player ended otherwise than with the host ({EndOf(player)}): {Last(player)}"));
        (double late, long accepted) = OfHost(host, failures);
        if (failures.Count == 0 && accepted == 0)
        {
            failures.Add("The host accepted nothing.");
        }

        return new StarvedOutcome(drawn, late, accepted, failures);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        StopStarving();
        foreach (StallProcess process in all)
        {
            process.Dispose();
        }
    }

    private void Starve(StallProcess host)
    {
        if (drawn.Share < 1)
        {
            string runs = Text(PeriodSeconds * drawn.Share), stands = Text(PeriodSeconds * (1 - drawn.Share));
            others.Add(Shell($"while kill -0 {Environment.ProcessId} && kill -STOP {host.Id}; do sleep {stands}; kill -CONT {host.Id}; sleep {runs}; done; kill -CONT {host.Id}"));
        }

        for (int n = 0; n < drawn.Spinning; n++)
        {
            others.Add(Shell($"while kill -0 {Environment.ProcessId}; do for n in 1 2 3 4 5 6 7 8 9; do :; done; done"));
        }
    }

    private void StopStarving()
    {
        foreach (Process other in others)
        {
            other.Kill(entireProcessTree: true);
            other.Dispose();
        }

        others.Clear();
        foreach (StallProcess process in all.Where(process => !process.HasExited))
        {
            process.Signal("CONT");
        }
    }

    private static Process Shell(string script) =>
        Process.Start(new ProcessStartInfo("sh") { ArgumentList = { "-c", script }, RedirectStandardError = true, RedirectStandardOutput = true })
        ?? throw new InvalidOperationException("'sh' was not started.");

    private static (double Late, long Accepted) OfHost(StallProcess host, List<string> failures)
    {
        try
        {
            using JsonDocument document = JsonDocument.Parse(host.Output);
            return (document.RootElement.GetProperty("world_late_max_ms").GetDouble() / 1000, document.RootElement.GetProperty("events_accepted").GetInt64());
        }
        catch (Exception why) when (why is JsonException or KeyNotFoundException or InvalidOperationException)
        {
            failures.Add($"The host left no result: {Last(host)}");
            return default;
        }
    }

    private static string EndOf(StallProcess player)
    {
        try
        {
            using JsonDocument document = JsonDocument.Parse(player.Output);
            return document.RootElement.GetProperty("ended_by").GetString() ?? "";
        }
        catch (Exception why) when (why is JsonException or KeyNotFoundException or InvalidOperationException)
        {
            return "no result";
        }
    }

    private StallProcess Run(params string[] arguments)
    {
        StallProcess process = new(tool, arguments);
        all.Add(process);
        return process;
    }

    private static string Last(StallProcess process) => process.Lines.LastOrDefault(line => line.Length > 2) ?? "it said nothing.";

    private static string Text(double value) => value.ToString("0.######", CultureInfo.InvariantCulture);
}
