using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Cli.Output;

/// <summary>The results of every strategy on every link, as JSON.</summary>
internal static class CompareJson
{
    internal static void Write(TextWriter output, IReadOnlyList<CompareRun> runs)
    {
        CompareOptions options = runs[0].Options;
        ulong? state = RunJson.Common(runs.SelectMany(run => run.StateHashes));
        JsonDocumentWriter.Write(output, "compare", options.Seed, options.Scene.Name, options.Scene.Hash, state, json =>
        {
            json.WriteStartArray("plan");
            foreach (PlannedAction action in options.Plan)
            {
                json.WriteStartObject();
                json.WriteNumber("time_s", action.Time.ToSeconds());
                json.WriteNumber("peer", action.Peer);
                json.WriteString("kind", KindOf(action));
                json.WriteString("body", BodyOf(options.Scene, action));
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteStartArray("runs");
            foreach (CompareRun run in runs)
            {
                Run(json, run);
            }

            json.WriteEndArray();
            CompareFindings findings = new(runs);
            Words(json, "interpolation_better_during", findings.BetterDuring);
            Words(json, "healing_worse_after", findings.HealingWorseAfter.Select(w => $"{w.Profile} {w.Strategy}"));
        });
    }

    /// <summary>Returns the kind of an action, as on the command line of <c>join --do</c>.</summary>
    internal static string KindOf(PlannedAction action) => action.Kind switch
    {
        Events.EventKind.SetVelocity => "set-velocity",
        _ => action.Kind.ToString().ToLowerInvariant(),
    };

    /// <summary>Returns the name of the body that an action is about; for a new one its identity.</summary>
    internal static string BodyOf(Scene scene, PlannedAction action) =>
        action.Kind == Events.EventKind.Spawn ? action.Body.ToString() : scene.Bodies[action.Body.Index].Name;

    private static void Run(Utf8JsonWriter json, CompareRun run)
    {
        MotionLaw[] laws = run.Options.Scene.Bodies.Select(body => body.Spec.Flight).Distinct().ToArray();
        json.WriteStartObject();
        RunJson.Setting(
            json, "plan", run.Options.Strategy, laws.Length == 1 ? MotionNames.Of(laws[0]) : null, "virtual", "virtual", run.Options.Link.Name, null, run.Options.Peers);
        RunJson.Figures(json, run, null);
        RunJson.Percentiles(json, "time_to_heal_ms", run.TimeToHeal);
        RunJson.MeanAndTail(json, "events_rerun", run.EventsRerun);
        RunJson.MeanAndTail(json, "cone_bodies", run.ConeBodies);
        RunJson.Percentiles(json, "corrections_seen_m", run.Corrections);
        json.WriteNumber("corrections_seen", run.CorrectionsSeen);
        RunJson.Phases(json, "seen_from_truth", run.SeenFromTruth);
        json.WriteString("truth_state_hash", JsonDocumentWriter.Hash(run.TruthStateHash));
        json.WriteString("truth_event_hash", JsonDocumentWriter.Hash(run.TruthEventHash));
        RunJson.Percentiles(json, "divergence_ms", run.Divergence);
        RunJson.Percentiles(json, "input_latency_ms", run.InputLatency);
        SimDuration delay = Net.Strategies.LateEventStrategies.Create(run.Options.Strategy, run.Options.DisplayDelay).DisplayDelay;
        json.WriteNumber("display_delay_ms", delay.ToMilliseconds());
        json.WriteEndObject();
    }

    private static void Words(Utf8JsonWriter json, string key, IEnumerable<string> words)
    {
        json.WriteStartArray(key);
        foreach (string word in words)
        {
            json.WriteStringValue(word);
        }

        json.WriteEndArray();
    }
}
