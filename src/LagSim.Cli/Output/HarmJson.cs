using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Verification.Harm;

namespace LagSim.Cli.Output;

/// <summary>Attacks, and the cost of honest players, as a JSON document.</summary>
internal static class HarmJson
{
    internal static void Write(
        TextWriter output,
        HarmOptions options,
        IReadOnlyList<HarmOutcome> outcomes,
        IReadOnlyList<HarmOutcome> worst,
        IReadOnlyList<HarmProcessOutcome> played,
        IReadOnlyList<HonestCost> costs,
        IReadOnlyList<StarvedOutcome> starved,
        bool isStopped) => JsonDocumentWriter.Write(output, "harm", options.Seed, null, null, null, json =>
        {
            Percentiles late = Percentiles.Of(outcomes.Select(o => o.LateSeconds * 1000));
            json.WriteNumber("attacks", outcomes.Count);
            json.WriteNumber("sent_away", outcomes.Count(o => o.IsExpelled));
            json.WriteNumber("late", outcomes.Count(o => o.LateSeconds > 0.25));
            json.WriteStartObject("late_ms");
            JsonDocumentWriter.Number(json, "p50", outcomes.Count == 0 ? null : late.P50);
            JsonDocumentWriter.Number(json, "p99", outcomes.Count == 0 ? null : late.P99);
            JsonDocumentWriter.Number(json, "max", outcomes.Count == 0 ? null : late.Max);
            json.WriteEndObject();
            json.WriteNumber("out_max_s", outcomes.Select(o => o.OutSeconds ?? 0).DefaultIfEmpty(0).Max());
            json.WriteNumber("back_max_s", outcomes.Select(o => o.BackSeconds ?? 0).DefaultIfEmpty(0).Max());
            json.WriteNumber("honest_part_max", outcomes.Select(o => o.HonestPart).DefaultIfEmpty(0).Max());
            json.WriteStartArray("failing_seeds");
            foreach (HarmOutcome o in outcomes.Where(o => !o.IsGood))
            {
                json.WriteNumberValue(o.Case.Seed);
            }

            json.WriteEndArray();
            json.WriteStartArray("worst");
            foreach (HarmOutcome o in worst)
            {
                json.WriteStartObject();
                json.WriteNumber("seed", o.Case.Seed);
                json.WriteString("case", o.Case.ToString());
                json.WriteString("replay", HarmText.Replay(o.Case));
                json.WriteNumber("late_ms", o.LateSeconds * 1000);
                JsonDocumentWriter.Number(json, "out_s", o.OutSeconds);
                JsonDocumentWriter.Number(json, "back_s", o.BackSeconds);
                json.WriteBoolean("sent_away", o.IsExpelled);
                json.WriteString("sentence", o.Sentence);
                End(json, o.Failures, o.IsGood);
            }

            json.WriteEndArray();
            json.WriteStartArray("processes");
            foreach (HarmProcessOutcome o in played)
            {
                json.WriteStartObject();
                json.WriteNumber("seed", o.Case.Seed);
                json.WriteString("replay", HarmText.Replay(o.Case, hasProcesses: true));
                json.WriteNumber("late_ms", o.LateSeconds * 1000);
                json.WriteNumber("states_compared", o.Compared);
                json.WriteString("sentence", o.Sentence);
                End(json, o.Failures, o.IsGood);
            }

            json.WriteEndArray();
            json.WriteStartArray("honest");
            foreach (HonestCost c in costs)
            {
                json.WriteStartObject();
                json.WriteString("scene", c.Scene);
                json.WriteNumber("players", c.Players);
                json.WriteNumber("events", c.Events);
                json.WriteNumber("work_per_s", c.WorkPerSecond);
                json.WriteNumber("most_at_once", c.PeakWork);
                json.WriteNumber("part_of_budget", c.Part);
                json.WriteNumber("sent_away", c.Expelled);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteStartArray("starved");
            foreach (StarvedOutcome o in starved)
            {
                json.WriteStartObject();
                json.WriteNumber("seed", o.Case.Seed);
                json.WriteString("case", o.Case.ToString());
                json.WriteNumber("late_ms", o.LateSeconds * 1000);
                json.WriteNumber("events_accepted", o.Accepted);
                End(json, o.Failures, o.IsGood);
            }

            json.WriteEndArray();
            json.WriteBoolean("stopped_early", isStopped);
        });

    private static void End(Utf8JsonWriter json, IReadOnlyList<string> failures, bool isGood)
    {
        json.WriteStartArray("failures");
        foreach (string failure in failures)
        {
            json.WriteStringValue(failure);
        }

        json.WriteEndArray();
        json.WriteBoolean("passed", isGood);
        json.WriteEndObject();
    }
}
