using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Net;
using System.Text.Json;
using System.Threading;
using LagSim.Harness.Relays;
using LagSim.Hosting;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>
/// Replays a drawn session with real processes that are stopped, killed and restarted, behind a relay that changes its ports.
/// </summary>
/// <remarks>For systems with signals. The processes' actions depend on their clocks; whether they agree does not.</remarks>
public sealed class StallProcessRun : IDisposable
{
    /// <summary>
    /// How long processes may take to start and join, on links of seconds and behind changing ports.
    /// </summary>
    private const double StartSeconds = 180;

    private const double LookSeconds = 0.5;

    private readonly StallCase drawn;
    private readonly IReadOnlyList<string> tool;
    private readonly string folder;
    private readonly CancellationToken cancellation;
    private readonly double length;
    private readonly SeededRandom random;
    private readonly Stopwatch watch = new();
    private readonly List<StallProcess> all = [];
    private readonly List<StallProcess> hosts = [];
    private readonly List<StallProcess>[] clients; // by number less one, each with all its restarts
    private readonly List<(double Seconds, string Text)>[] actions;
    private readonly List<string> failures = [];
    private readonly UdpRelay[] relays; // of each client
    private readonly string?[] numbers; // the first number that each client got
    private readonly Action<double, string?>? progress;
    private string port = "0";

    /// <summary>Prepares a session.</summary>
    /// <param name="drawn">The session.</param>
    /// <param name="recoverySeconds">The longest known time until all peers are up to date after the last stall, in seconds.</param>
    /// <param name="tool">The tool's program, and the arguments that it needs before its own.</param>
    /// <param name="folder">An existing folder for passes.</param>
    /// <param name="cancellation">Ends it early.</param>
    /// <param name="progress">Called on the playing thread with the seconds of <see cref="SecondsOf"/> that have passed, and a description
    /// of anything that happens; may be null.</param>
    public StallProcessRun(
        StallCase drawn, double recoverySeconds, IReadOnlyList<string> tool, string folder, CancellationToken cancellation, Action<double, string?>? progress = null)
    {
        ArgumentNullException.ThrowIfNull(drawn);
        ArgumentNullException.ThrowIfNull(tool);
        ArgumentNullException.ThrowIfNull(folder);
        this.drawn = drawn;
        this.tool = tool;
        this.folder = folder;
        this.cancellation = cancellation;
        this.progress = progress;
        length = SecondsOf(drawn, recoverySeconds);
        random = new SeededRandom(drawn.Seed).Fork(0x9C);
        clients = [.. Enumerable.Range(0, drawn.Clients).Select(_ => new List<StallProcess>())];
        relays = new UdpRelay[drawn.Clients];
        numbers = new string?[drawn.Clients];
        actions = [.. clients.Select(_ => Draw())];
    }

    /// <summary>
    /// Returns how long a session is played, in seconds, once all are in. Processes need more time to start and join.
    /// </summary>
    /// <param name="drawn">The session.</param>
    /// <param name="recoverySeconds">The longest known time until all peers are up to date after the last stall, in seconds.</param>
    public static double SecondsOf(StallCase drawn, double recoverySeconds)
    {
        ArgumentNullException.ThrowIfNull(drawn);
        return Math.Ceiling(drawn.EndSeconds + (1.5 * recoverySeconds) + 30);
    }

    /// <summary>Plays the session.</summary>
    public StallProcessOutcome Play()
    {
        if (Start())
        {
            watch.Start();
            Tell("all are in");
            List<(double At, Action What)> plan = [.. drawn.Stalls.Select(s => (s.AtSeconds, (Action)(() => Begin(s))))];
            plan.AddRange(drawn.Stalls.Select(s => (s.EndSeconds, (Action)(() => End(s)))));
            foreach (Stall stall in drawn.Stalls.Where(s => s.Kind == StallKind.PortChanges))
            {
                for (double at = stall.AtSeconds; at < stall.EndSeconds; at += Stall.ChangeSeconds)
                {
                    plan.Add((at, relays[stall.Player - 1].ChangePorts));
                }
            }

            foreach ((double at, Action what) in plan.OrderBy(step => step.At))
            {
                Wait(at);
                what();
            }

            AwaitEnds();
        }

        (long compared, long differed) = Compare();
        return new StallProcessOutcome(drawn, compared, differed, failures);
    }

    /// <summary>Kills the processes that still run.</summary>
    public void Dispose()
    {
        foreach (IDisposable part in all.Concat<IDisposable>(relays.OfType<UdpRelay>()))
        {
            part.Dispose();
        }
    }

    private bool Start()
    {
        StallProcess host = StartHost(drawn.Clients, length);
        if (host.Await("listening on ", StartSeconds, cancellation) is not string address)
        {
            failures.Add($"The host does not listen: {Last(host)}");
            return false;
        }

        port = address[(address.LastIndexOf(':') + 1)..];
        for (int n = 0; n < clients.Length; n++)
        {
            IPEndPoint there = IPEndPoint.Parse(address);
            relays[n] = new UdpRelay(new IPEndPoint(IPAddress.Loopback, 0), there, drawn.Link, drawn.Seed + (ulong)n, new StopwatchClock());
            StartClient(n);
        }

        for (int n = 0; n < clients.Length; n++)
        {
            if (clients[n][0].Await("T ", StartSeconds, cancellation) is null)
            {
                failures.Add($"Client {n + 1} did not get in: {Last(clients[n][0])}");
                return false;
            }

            numbers[n] = File.ReadAllText(PassOf(n)).Split('-')[0];
        }

        return true;
    }

    private StallProcess StartHost(int expected, double seconds)
    {
        StallProcess host = Run(
            "host", "--scene", "billiards", "--joiners", Text(expected), "--budget", "0", "--port", port,
            "--identity", IdentityPath, "--for-s", Text(Math.Max(1, Math.Ceiling(seconds))), "--json");
        hosts.Add(host);
        return host;
    }

    /// <summary>Schedules the remaining actions of a client that joins late, some time after that.</summary>
    private void StartClient(int n)
    {
        double from = clients[n].Count == 0 ? 3 : watch.Elapsed.TotalSeconds + 15;
        IEnumerable<string> done = actions[n].Where(d => d.Seconds > from).SelectMany(d => new[] { "--do", d.Text });
        clients[n].Add(Run(["join", relays[n].LocalAddress.ToString(), "--pass", PassOf(n), "--json", .. done]));
    }

    private StallProcess Run(params string[] arguments)
    {
        StallProcess process = new(tool, arguments);
        all.Add(process);
        return process;
    }

    private void Tell(string? what) => progress?.Invoke(Math.Min(watch.Elapsed.TotalSeconds, length), what);

    private void Begin(Stall stall)
    {
        Tell(stall.ToString());
        if (stall.Kind is StallKind.HostFrozen or StallKind.ClientFrozen)
        {
            Of(stall.Player).Signal("STOP");
        }
        else if (stall.Kind is StallKind.HostKilled or StallKind.ClientKilled)
        {
            Of(stall.Player).Kill();
        }
    }

    private void End(Stall stall)
    {
        Tell($"over: {stall}");
        switch (stall.Kind)
        {
            case StallKind.HostFrozen or StallKind.ClientFrozen:
                Of(stall.Player).Signal("CONT");
                break;
            case StallKind.HostKilled:
                StartHost(0, length - watch.Elapsed.TotalSeconds);
                break;
            case StallKind.ClientKilled:
                StartClient(stall.Player - 1);
                break;
        }
    }

    private StallProcess Of(int player) => player == 0 ? hosts[^1] : clients[player - 1][^1];

    private void AwaitEnds()
    {
        for (double seconds = 0; seconds < length + StartSeconds && !hosts[^1].AwaitEnd(LookSeconds, cancellation); seconds += LookSeconds)
        {
            Tell(null);
        }

        if (!hosts[^1].AwaitEnd(0, cancellation))
        {
            failures.Add("The host did not end.");
        }

        for (int n = 0; n < clients.Length; n++)
        {
            StallProcess client = clients[n][^1];
            if (!client.AwaitEnd(30, cancellation))
            {
                failures.Add($"Client {n + 1} did not end with the host: {Last(client)}");
                continue;
            }

            Validate(n, client);
        }
    }

    private void Validate(int n, StallProcess client)
    {
        try
        {
            using JsonDocument document = JsonDocument.Parse(client.Output);
            JsonElement root = document.RootElement;
            string by = root.TryGetProperty("ended_by", out JsonElement ended) ? ended.GetString() ?? "" : "";
            if (by != "host-ended")
            {
                failures.Add($"Client {n + 1} ended otherwise than with the host: {by} {Last(client)}");
            }
            else if (Text(root.GetProperty("peer").GetInt32()) != numbers[n])
            {
                failures.Add($"Client {n + 1} was player {numbers[n]}, and came back as player {root.GetProperty("peer").GetInt32()}.");
            }
            else if (root.GetProperty("states_differed").GetInt64() is > 0 and long differed)
            {
                failures.Add($"Client {n + 1} says that {differed} of its states differed.");
            }
        }
        catch (JsonException)
        {
            failures.Add($"Client {n + 1} left no result: {Last(client)}");
        }

        bool isTouched = drawn.Stalls.Any(s => s.Touches(n + 1));
        if (!isTouched && client.Lines.FirstOrDefault(l => l.Contains("let in again", StringComparison.Ordinal)) is string line)
        {
            failures.Add($"Client {n + 1}, to whom nothing happened, was interrupted: {line}");
        }
    }

    /// <summary>Compares every state that a client printed with the host's of the same time.</summary>
    private (long Compared, long Differed) Compare()
    {
        ILookup<string, string> theirs = hosts.SelectMany(States).ToLookup(s => s.Time, s => s.Hashes);
        double last = hosts.Count == 0 ? 0 : States(hosts[^1]).Select(s => Seconds(s.Time)).DefaultIfEmpty(0).Max();
        long compared = 0;
        long differed = 0;
        for (int n = 0; n < clients.Length; n++)
        {
            (string Time, string Hashes)[] both = [.. clients[n].SelectMany(States).Where(s => theirs.Contains(s.Time))];
            compared += both.Length;
            differed += both.Count(s => !theirs[s.Time].Contains(s.Hashes));
            double reachedSeconds = clients[n].Count == 0 ? 0 : States(clients[n][^1]).Select(s => Seconds(s.Time)).DefaultIfEmpty(0).Max();
            if (failures.Count == 0 && reachedSeconds < last - 10)
            {
                failures.Add(string.Create(CultureInfo.InvariantCulture, $"Client {n + 1} was committed to {reachedSeconds} s, the host to {last} s."));
            }
        }

        return (compared, differed);
    }

    private static IEnumerable<(string Time, string Hashes)> States(StallProcess process) =>
        from line in process.Lines
        let words = line.Split(' ')
        where words.Length == 7 && words[0] == "T" && words[3] == "state"
        select (words[1], $"{words[4]} {words[6]}");

    private List<(double, string)> Draw()
    {
        List<(double, string)> drawnActions = [];
        for (double at = 3; at < length; at += (0.5 + random.NextDouble()) / drawn.EventsPerSecond)
        {
            drawnActions.Add((at, string.Create(
                CultureInfo.InvariantCulture, $"set-velocity@{at:0.000}:{random.NextDouble(-1, 1):0.000},0,{random.NextDouble(-1, 1):0.000}")));
        }

        return drawnActions;
    }

    private void Wait(double seconds)
    {
        double left;
        while ((left = seconds - watch.Elapsed.TotalSeconds) > 0)
        {
            cancellation.WaitHandle.WaitOne(TimeSpan.FromSeconds(Math.Min(left, LookSeconds)));
            cancellation.ThrowIfCancellationRequested();
            Tell(null);
        }
    }

    private string PassOf(int n) => Path.Combine(folder, Text(n + 1) + ".pass");

    private string IdentityPath => Path.Combine(folder, "host.identity");

    private static string Last(StallProcess process) => process.Lines.LastOrDefault() ?? "it said nothing.";

    private static double Seconds(string text) => double.Parse(text, CultureInfo.InvariantCulture);

    private static string Text(IFormattable value) => value.ToString(null, CultureInfo.InvariantCulture);
}
