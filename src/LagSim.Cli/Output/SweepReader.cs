using System;
using System.Collections.Generic;
using System.IO;
using System.Text.Json;
using LagSim.Harness.Experiments.Sweep;

namespace LagSim.Cli.Output;

/// <summary>Reads the output of <see cref="SweepJson"/>, so that one run can be drawn beside another.</summary>
internal static class SweepReader
{
    /// <summary>Returns the cells of a sweep's JSON document, as far as a chart needs them.</summary>
    /// <exception cref="InputException">The file cannot be read, or is not from <c>lagsim sweep --json</c>; the message says
    /// which.</exception>
    internal static IReadOnlyList<SweepOutcome> Read(string path)
    {
        try
        {
            using JsonDocument document = JsonDocument.Parse(File.ReadAllBytes(path));
            List<SweepOutcome> outcomes = [];
            foreach (JsonElement cell in document.RootElement.GetProperty("cells").EnumerateArray())
            {
                outcomes.Add(new SweepOutcome
                {
                    Cell = new SweepCell(
                        cell.GetProperty("clients").GetInt32(), Number(cell, "events_per_s"), cell.GetProperty("rate_bit_per_s").GetInt64(), Number(cell, "queue_ms"),
                        cell.GetProperty("dips").GetBoolean()),
                    LoadShare = Number(cell, "load_share"),
                    OfferedBytesPerSecond = Number(cell, "offered_bytes_per_s"),
                    DeliveredBytesPerSecond = Number(cell, "delivered_bytes_per_s"),
                    SentBytesPerSecond = Number(cell, "sent_bytes_per_s"),
                    IdleRoundTripMs = Number(cell, "idle_round_trip_ms"),
                    RoundTripP50Ms = Number(cell, "round_trip_p50_ms"),
                    RoundTripP99Ms = Number(cell, "round_trip_p99_ms"),
                    Done = cell.GetProperty("events_done").GetInt64(),
                    Refused = cell.GetProperty("events_refused").GetInt64(),
                    Lost = cell.GetProperty("events_lost").GetInt64(),
                    Differed = cell.GetProperty("states_differed").GetInt64(),
                });
            }

            return outcomes;
        }
        catch (Exception mistake) when (mistake is IOException or UnauthorizedAccessException)
        {
            throw new InputException(
                Directory.Exists(path) ? $"--beside is '{path}', which is a folder; it must be a file that lagsim sweep --json wrote." : $"--beside is '{path}', which cannot be read. {mistake.Message}");
        }
        catch (Exception mistake) when (mistake is JsonException or KeyNotFoundException or InvalidOperationException or FormatException)
        {
            throw new InputException($"--beside is '{path}', which is not what lagsim sweep --json writes: an object with 'cells', each with the keys of its outcome.", mistake);
        }
    }

    private static double Number(JsonElement cell, string name) => cell.GetProperty(name).GetDouble();
}
