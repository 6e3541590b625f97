using System.Collections.Generic;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Reports;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The JSON keys that the runs of every peer comparison have in common.</summary>
public static class RunJson
{
    /// <summary>The keys that every run begins with: what was run.</summary>
    public static void Setting(
        Utf8JsonWriter json, string which, string strategy, string? motion, string time, string transport, string? profile, double? delay,
        int peers)
    {
        json.WriteString("case", which);
        json.WriteString("strategy", strategy);
        json.WriteString("motion", motion);
        json.WriteString("time", time);
        json.WriteString("transport", transport);
        json.WriteString("profile", profile);
        JsonValues.Number(json, "delay_ms", delay);
        json.WriteNumber("peers", peers);
    }

    /// <summary>The keys that follow: the results.</summary>
    public static void Figures(Utf8JsonWriter json, IPeerRun run, double? cpuCoresAtRest)
    {
        Phases(json, "seen", run.Seen);
        Phases(json, "seen_true_time", run.SeenTrueTime);
        Phases(json, "settled", run.Settled);
        Hashes(json, "state_hashes", run.StateHashes);
        Hashes(json, "event_hashes", run.EventHashes);
        json.WriteNumber("clock_error_ms", run.ClockErrorMilliseconds);
        json.WriteNumber("events", run.Events);
        json.WriteNumber("heals", run.Heals);
        Numbers(json, "bytes_sent_per_s", run.BytesSentPerSecond);
        Percentiles(json, "event_lateness_ms", run.Lateness);
        JsonValues.Number(json, "cpu_cores_at_rest", cpuCoresAtRest);
    }

    private static void Hashes(Utf8JsonWriter json, string key, IReadOnlyList<ulong> hashes)
    {
        json.WriteStartArray(key);
        foreach (ulong hash in hashes)
        {
            json.WriteStringValue(JsonValues.Hash(hash));
        }

        json.WriteEndArray();
    }

    /// <summary>The errors of each phase.</summary>
    public static void Phases(Utf8JsonWriter json, string key, PhaseErrors errors)
    {
        json.WriteStartObject(key);
        Errors(json, "before", errors.Before.ToStatistics());
        Errors(json, "during", errors.During.ToStatistics());
        Errors(json, "after", errors.After.ToStatistics());
        json.WriteEndObject();
    }

    /// <summary>Writes one error.</summary>
    /// <param name="json">The destination.</param>
    /// <param name="key">The key.</param>
    /// <param name="errors">The statistics of the error.</param>
    /// <param name="without">The value in place of the figures of no sample: 0 where a phase may be empty, null where nothing could be
    /// measured.</param>
    public static void Errors(Utf8JsonWriter json, string key, in ErrorStatistics errors, double? without = 0)
    {
        double? Figure(double metres, long samples) => samples == 0 ? without : metres;
        json.WriteStartObject(key);
        json.WriteNumber("samples", errors.Samples);
        JsonValues.Number(json, "max_m", Figure(errors.MaxMetres, errors.Samples));
        JsonValues.Number(json, "mean_m", Figure(errors.MeanMetres, errors.Samples));
        JsonValues.Number(json, "rms_m", Figure(errors.RmsMetres, errors.Samples));
        json.WriteNumber("differing_bits", errors.DifferingBits);
        json.WriteNumber("stalled_samples", errors.StalledSamples);
        json.WriteEndObject();
    }

    private static void Numbers(Utf8JsonWriter json, string key, IReadOnlyList<double> numbers)
    {
        json.WriteStartArray(key);
        foreach (double number in numbers)
        {
            json.WriteNumberValue(number);
        }

        json.WriteEndArray();
    }

    /// <summary>Percentiles of a figure.</summary>
    public static void Percentiles(Utf8JsonWriter json, string key, Percentiles of)
    {
        json.WriteStartObject(key);
        json.WriteNumber("p50", of.P50);
        json.WriteNumber("p99", of.P99);
        json.WriteNumber("max", of.Max);
        json.WriteEndObject();
    }

    /// <summary>The mean of a figure, and its 99th percentile.</summary>
    public static void MeanAndTail(Utf8JsonWriter json, string key, MeanAndTail of)
    {
        json.WriteStartObject(key);
        json.WriteNumber("mean", of.Mean);
        json.WriteNumber("p99", of.P99);
        json.WriteEndObject();
    }

    /// <summary>Returns the hash that all have in common; null if they differ.</summary>
    public static ulong? Common(IEnumerable<ulong> hashes)
    {
        ulong[] different = hashes.Distinct().ToArray();
        return different.Length == 1 ? different[0] : null;
    }
}
