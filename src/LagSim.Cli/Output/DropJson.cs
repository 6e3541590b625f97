using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Drop;
using LagSim.Harness.Metrics;
using LagSim.Harness.Scenes;

namespace LagSim.Cli.Output;

/// <summary>A drop test as JSON.</summary>
internal static class DropJson
{
    internal static void Write(TextWriter output, DropOptions options, IReadOnlyList<DropRun> runs)
    {
        ulong? scene = Common(runs.Select(run => run.SceneHash));
        ulong? state = Common(runs.SelectMany(run => run.StateHashes));
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
        Phases(json, "seen", run.Seen);
        Phases(json, "seen_true_time", run.SeenTrueTime);
        Phases(json, "settled", run.Settled);
        Hashes(json, "state_hashes", run.StateHashes);
        Hashes(json, "event_hashes", run.EventHashes);
        json.WriteNumber("clock_error_ms", run.ClockErrorMilliseconds);
        json.WriteNumber("events", run.Events);
        json.WriteNumber("heals", run.Heals);
        json.WriteStartArray("bytes_sent_per_s");
        foreach (double bytes in run.BytesSentPerSecond)
        {
            json.WriteNumberValue(bytes);
        }

        json.WriteEndArray();
        json.WriteStartObject("event_lateness_ms");
        json.WriteNumber("p50", run.Lateness.P50);
        json.WriteNumber("p99", run.Lateness.P99);
        json.WriteNumber("max", run.Lateness.Max);
        json.WriteEndObject();
        JsonDocumentWriter.Number(json, "cpu_cores_at_rest", run.CpuCoresAtRest);
        json.WriteEndObject();
    }

    private static void Hashes(Utf8JsonWriter json, string key, IReadOnlyList<ulong> hashes)
    {
        json.WriteStartArray(key);
        foreach (ulong hash in hashes)
        {
            json.WriteStringValue(JsonDocumentWriter.Hash(hash));
        }

        json.WriteEndArray();
    }

    private static void Phases(Utf8JsonWriter json, string key, PhaseErrors errors)
    {
        json.WriteStartObject(key);
        Errors(json, "before", errors.Before.ToStatistics());
        Errors(json, "during", errors.During.ToStatistics());
        Errors(json, "after", errors.After.ToStatistics());
        json.WriteEndObject();
    }

    private static void Errors(Utf8JsonWriter json, string key, in ErrorStatistics errors)
    {
        json.WriteStartObject(key);
        json.WriteNumber("samples", errors.Samples);
        json.WriteNumber("max_m", errors.MaxMetres);
        json.WriteNumber("mean_m", errors.MeanMetres);
        json.WriteNumber("rms_m", errors.RmsMetres);
        json.WriteNumber("differing_bits", errors.DifferingBits);
        json.WriteNumber("stalled_samples", errors.StalledSamples);
        json.WriteEndObject();
    }

    /// <summary>The one hash that all have; null where there are several.</summary>
    private static ulong? Common(IEnumerable<ulong> hashes)
    {
        ulong[] different = hashes.Distinct().ToArray();
        return different.Length == 1 ? different[0] : null;
    }
}
