using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Drop;
using LagSim.Harness.Scenes;

namespace LagSim.Cli.Output;

/// <summary>A drop test as JSON.</summary>
internal static class DropJson
{
    internal static void Write(TextWriter output, DropOptions options, IReadOnlyList<DropRun> runs)
    {
        ulong? scene = RunJson.Common(runs.Select(run => run.SceneHash));
        ulong? state = RunJson.Common(runs.SelectMany(run => run.StateHashes));
        JsonDocumentWriter.Write(output, "drop", options.Seed, "drop", scene, state, json =>
        {
            json.WriteStartArray("runs");
            foreach (DropRun run in runs)
            {
                Run(json, run);
            }

            json.WriteEndArray();
        });
    }

    private static void Run(Utf8JsonWriter json, DropRun run)
    {
        json.WriteStartObject();
        json.WriteString("case", DropNames.Case(run.Case));
        json.WriteString("strategy", run.Options.Strategy);
        json.WriteString("motion", MotionNames.Of(run.Options.Motion));
        json.WriteString("time", DropNames.Time(run.Options));
        json.WriteString("transport", DropNames.Transport(run.Options));
        json.WriteString("profile", run.Options.DelayMilliseconds is null ? run.Options.Link.Name : null);
        JsonDocumentWriter.Number(json, "delay_ms", run.Options.DelayMilliseconds);
        json.WriteNumber("peers", run.Options.Peers);
        RunJson.Phases(json, "seen", run.Seen);
        RunJson.Phases(json, "seen_true_time", run.SeenTrueTime);
        RunJson.Phases(json, "settled", run.Settled);
        RunJson.Hashes(json, "state_hashes", run.StateHashes);
        RunJson.Hashes(json, "event_hashes", run.EventHashes);
        json.WriteNumber("clock_error_ms", run.ClockErrorMilliseconds);
        json.WriteNumber("events", run.Events);
        json.WriteNumber("heals", run.Heals);
        RunJson.Numbers(json, "bytes_sent_per_s", run.BytesSentPerSecond);
        RunJson.Percentiles(json, "event_lateness_ms", run.Lateness);
        JsonDocumentWriter.Number(json, "cpu_cores_at_rest", run.CpuCoresAtRest);
        json.WriteEndObject();
    }
}
