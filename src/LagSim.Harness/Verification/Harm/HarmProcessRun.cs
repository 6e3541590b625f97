using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Net;
using System.Text.Json;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Relays;
using LagSim.Harness.SceneFiles;
using LagSim.Harness.Verification.Stalls;
using LagSim.Hosting;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Harm;

/// <summary>Replays a drawn attack with real processes: a host, two observers, and an attacker behind a relay.</summary>
/// <remarks>Timings depend on the machine. The velocity of a spawn is set by a separate event here.</remarks>
public sealed class HarmProcessRun : IDisposable
{
    /// <summary>How long it is played, in seconds.</summary>
    public const double PlaySeconds = HarmCase.Seconds + From + 6;

    private const double From = 2;
    private const double StartSeconds = 60;
    private const int Others = 2;

    private readonly HarmCase drawn;
    private readonly IReadOnlyList<string> tool;
    private readonly string folder;
    private readonly CancellationToken cancellation;
    private readonly List<StallProcess> all = [];
    private readonly List<string> failures = [];
    private UdpRelay? relay;

    /// <summary>Prepares an attack.</summary>
    /// <param name="drawn">The attack.</param>
    /// <param name="tool">The tool's program, and the arguments that it needs before its own.</param>
    /// <param name="folder">An existing folder for the scene.</param>
    /// <param name="cancellation">Ends it early.</param>
    public HarmProcessRun(HarmCase drawn, IReadOnlyList<string> tool, string folder, CancellationToken cancellation)
    {
        ArgumentNullException.ThrowIfNull(drawn);
        ArgumentNullException.ThrowIfNull(tool);
        ArgumentNullException.ThrowIfNull(folder);
        this.drawn = drawn;
        this.tool = tool;
        this.folder = folder;
        this.cancellation = cancellation;
    }

    /// <summary>Plays the attack.</summary>
    public HarmProcessOutcome Play()
    {
        string scene = Path.Combine(folder, "scene.json");
        SceneFile.Write(drawn.Scene, scene);
        StallProcess host = Run("host", "--scene", scene, "--joiners", Text(Others + 1), "--for-s", Text(PlaySeconds), "--json");
        if (host.Await("listening on ", StartSeconds, cancellation) is not string address)
        {
            return Outcome(host, [], [$"The host does not listen: {Last(host)}"]);
        }

        // One after the other, so that each player's number is known.
        List<StallProcess> others = [];
        for (int n = 0; n < Others; n++)
        {
            others.Add(Run("join", address, "--json"));
            if (host.Await(string.Create(CultureInfo.InvariantCulture, $"peer {n + 1} at"), StartSeconds, cancellation) is null)
            {
                return Outcome(host, others, [$"Peer {n + 1} did not get in: {Last(others[n])}"]);
            }
        }

        relay = new UdpRelay(
            new IPEndPoint(IPAddress.Loopback, 0), IPEndPoint.Parse(address), LinkProfiles.PureDelay(drawn.LinkMilliseconds), drawn.Seed, new StopwatchClock());
        HarmAction[] actions = [.. drawn.Actions.Where(action => action.Kind != EventKind.SetFilter && action.Spec is null)]; // what the tool has words for
        uint[] sequences =
        [
            .. actions.Select((action, n) => (action, n)).Where(d => d.action.Kind == EventKind.Spawn).Select(d => (uint)d.n + 1),
        ];
        StallProcess attacker = Run([
            "join", relay.LocalAddress.ToString(), "--json",
            .. actions.SelectMany(action => new[] { "--do", action.ToText(drawn.Scene, From, Others + 1, n => sequences[n]) })]);
        if (!host.AwaitEnd(PlaySeconds + StartSeconds, cancellation))
        {
            failures.Add("The host did not end in time.");
            host.Kill();
        }

        foreach (StallProcess process in others.Append(attacker))
        {
            if (!process.AwaitEnd(20, cancellation))
            {
                failures.Add($"A client did not end with the host: {Last(process)}");
                process.Kill();
            }
        }

        return Outcome(host, others, []);
    }

    /// <summary>Kills the processes that still run.</summary>
    public void Dispose()
    {
        foreach (StallProcess process in all)
        {
            process.Dispose();
        }

        relay?.Dispose();
    }

    private HarmProcessOutcome Outcome(StallProcess host, List<StallProcess> others, IEnumerable<string> more)
    {
        failures.AddRange(more);
        string sentence = host.Lines.FirstOrDefault(line => line.Contains("is disconnected", StringComparison.Ordinal)) ?? "";
        double late = 0;
        long compared = 0;
        foreach (StallProcess process in failures.Count == 0 ? others.Prepend(host) : [])
        {
            try
            {
                using JsonDocument document = JsonDocument.Parse(process.Output);
                late = Math.Max(late, document.RootElement.GetProperty("world_late_max_ms").GetDouble() / 1000);
                compared += document.RootElement.GetProperty("states_agreed").GetInt64();
                if (process != host && document.RootElement.GetProperty("states_differed").GetInt64() is > 0 and long differed)
                {
                    failures.Add($"{differed} states differ.");
                }

                string by = document.RootElement.GetProperty("ended_by").GetString() ?? "";
                if (process != host && by != "host-ended")
                {
                    failures.Add($"One that only looked on ended otherwise than with the host: {by}. {Last(process)}");
                }
            }
            catch (Exception why) when (why is JsonException or KeyNotFoundException or InvalidOperationException)
            {
                failures.Add($"A process left no result: {Last(process)}");
            }
        }

        if (late > HarmRun.MaxLate && (sentence.Length == 0 || late > HarmRun.MaxSeconds))
        {
            failures.Add(string.Create(CultureInfo.InvariantCulture, $"A world was {late:0.00} s late{(sentence.Length == 0 ? ", and the player stayed" : "")}."));
        }

        if (failures.Count == 0 && compared == 0)
        {
            failures.Add("No states were compared.");
        }

        return new HarmProcessOutcome(drawn, late, sentence, compared, failures);
    }

    private StallProcess Run(params string[] arguments)
    {
        StallProcess process = new(tool, arguments);
        all.Add(process);
        return process;
    }

    private static string Last(StallProcess process) => process.Lines.LastOrDefault() ?? "it said nothing.";

    private static string Text(double value) => value.ToString("0.###", CultureInfo.InvariantCulture);
}
