using System.Collections.Generic;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Metrics;

namespace LagSim.Cli.Output;

/// <summary>What the runs of every command that compares peers have in common, as JSON.</summary>
internal static class RunJson
{
    internal static void Hashes(Utf8JsonWriter json, string key, IReadOnlyList<ulong> hashes)
    {
        json.WriteStartArray(key);
        foreach (ulong hash in hashes)
        {
            json.WriteStringValue(JsonDocumentWriter.Hash(hash));
        }

        json.WriteEndArray();
    }

    internal static void Phases(Utf8JsonWriter json, string key, PhaseErrors errors)
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

    internal static void Numbers(Utf8JsonWriter json, string key, IReadOnlyList<double> numbers)
    {
        json.WriteStartArray(key);
        foreach (double number in numbers)
        {
            json.WriteNumberValue(number);
        }

        json.WriteEndArray();
    }

    internal static void Percentiles(Utf8JsonWriter json, string key, Percentiles of)
    {
        json.WriteStartObject(key);
        json.WriteNumber("p50", of.P50);
        json.WriteNumber("p99", of.P99);
        json.WriteNumber("max", of.Max);
        json.WriteEndObject();
    }

    internal static void MeanAndTail(Utf8JsonWriter json, string key, MeanAndTail of)
    {
        json.WriteStartObject(key);
        json.WriteNumber("mean", of.Mean);
        json.WriteNumber("p99", of.P99);
        json.WriteEndObject();
    }

    /// <summary>The one hash that all have; null where there are several.</summary>
    internal static ulong? Common(IEnumerable<ulong> hashes)
    {
        ulong[] different = hashes.Distinct().ToArray();
        return different.Length == 1 ? different[0] : null;
    }
}
