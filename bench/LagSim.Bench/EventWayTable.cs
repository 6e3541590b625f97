using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Net.Sessions;

namespace LagSim.Bench;

/// <summary>How long an event takes from its stamp to the other peer's published world, over loopback UDP and without delay; and the first of its kind in a process.</summary>
/// <remarks>What has been compiled counts, so each run is a process of its own, which <see cref="EventWayRun"/> is.</remarks>
internal static class EventWayTable
{
    /// <summary>The first argument of such a process; the rounds and a seed follow.</summary>
    internal const string RunName = "way-run";

    internal static void Print(bool brief)
    {
        int runs = brief ? 1 : 5;
        int rounds = brief ? 3 : 50;
        Console.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"An event's way over loopback UDP, {runs} processes of {rounds} events of each of 8 kinds and of each of 2 peers, 5 to 50 ms apart, p50 / p99 / max in ms"));
        Run[] all = Enumerable.Range(1, runs).Select(seed => Start(rounds, seed)).ToArray();
        Console.WriteLine("| who | stamp to the other's published world | the first of its kind | of it until it is in the other's world | asked for to stamp |");
        Console.WriteLine("|---|---|---|---|---|");
        foreach (string who in new[] { "host", "client" })
        {
            List<Way> ways = all.SelectMany(r => r.Ways).Where(w => w.Who == who).ToList();
            Console.WriteLine($"| {who} | {Text(ways.Where(w => !w.IsFirst).Select(w => w.Shown))} | {Text(ways.Where(w => w.IsFirst).Select(w => w.Shown))} | {Text(ways.Select(w => w.Applied))} | {Text(ways.Select(w => w.Asked))} |");
        }

        Console.WriteLine();
        Console.WriteLine("| kind | stamp to published | the first |");
        Console.WriteLine("|---|---|---|");
        foreach (string kind in all[0].Ways.Select(w => w.Kind).Distinct())
        {
            List<Way> ways = all.SelectMany(r => r.Ways).Where(w => w.Kind == kind).ToList();
            Console.WriteLine($"| {kind} | {Text(ways.Where(w => !w.IsFirst).Select(w => w.Shown))} | {Text(ways.Where(w => w.IsFirst).Select(w => w.Shown))} |");
        }

        Console.WriteLine();
        foreach (Run run in all)
        {
            Console.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"Host() returned after {run.Process[0]:0} ms, both run after {run.Process[1]:0} ms; at rest {run.Process[2]:P2} of a core; {run.Process[3]:0} methods compiled while events went, {run.Process[4]:0} ms; {run.Process[5]:0} collections"));
        }
    }

    internal static int RunOne(string[] arguments)
    {
        EventWayRun.Print(new HostOptions(), int.Parse(arguments[1], CultureInfo.InvariantCulture), int.Parse(arguments[2], CultureInfo.InvariantCulture));
        return 0;
    }

    private static Run Start(int rounds, int seed)
    {
        ProcessStartInfo start = new(Environment.ProcessPath!) { RedirectStandardOutput = true };
        if (!Environment.ProcessPath!.Contains("LagSim.Bench", StringComparison.Ordinal))
        {
            start.ArgumentList.Add(Environment.GetCommandLineArgs()[0]); // started by dotnet
        }

        foreach (string argument in new[] { RunName, rounds.ToString(CultureInfo.InvariantCulture), seed.ToString(CultureInfo.InvariantCulture) })
        {
            start.ArgumentList.Add(argument);
        }

        using Process process = Process.Start(start)!;
        string[] lines = process.StandardOutput.ReadToEnd().Split('\n', StringSplitOptions.RemoveEmptyEntries);
        process.WaitForExit();
        if (process.ExitCode != 0)
        {
            throw new InvalidOperationException($"A run ended with exit code {process.ExitCode}.");
        }

        HashSet<string> met = new();
        List<Way> ways = new();
        double[] figures = Array.Empty<double>();
        foreach (string[] words in lines.Select(l => l.Split(' ')))
        {
            if (words[0] == "process")
            {
                figures = words.Skip(1).Select(Number).ToArray();
            }
            else
            {
                ways.Add(new Way(words[0], words[1], Number(words[2]), Number(words[3]), Number(words[4]), met.Add($"{words[0]} {words[1]}")));
            }
        }

        return new Run(ways, figures);
    }

    private static double Number(string word) => double.Parse(word, CultureInfo.InvariantCulture);

    private static string Text(IEnumerable<double> milliseconds)
    {
        Percentiles p = Percentiles.Of(milliseconds);
        return string.Create(CultureInfo.InvariantCulture, $"{p.P50:0.00} / {p.P99:0.00} / {p.Max:0.00}");
    }

    private sealed record Way(string Who, string Kind, double Applied, double Shown, double Asked, bool IsFirst);

    private sealed record Run(IReadOnlyList<Way> Ways, double[] Process);
}
