using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Verification.Stalls;

namespace LagSim.Cli.Output;

/// <summary>Sessions with stalls as a JSON document.</summary>
internal static class StallsJson
{
    internal static void Write(
        TextWriter output,
        StallOptions options,
        IReadOnlyList<StallOutcome> outcomes,
        IReadOnlyList<StallOutcome> worst,
        IReadOnlyList<StallProcessOutcome> played,
        bool isStopped) => JsonDocumentWriter.Write(output, "stalls", options.Seed, null, null, null, json =>
        {
            Percentiles recovery = Percentiles.Of(outcomes.SelectMany(o => o.RecoverySeconds));
            json.WriteNumber("sessions", outcomes.Count);
            json.WriteNumber("stalls", outcomes.Sum(o => o.Case.Stalls.Count));
            json.WriteNumber("states_compared", outcomes.Sum(o => o.Compared));
            json.WriteNumber("states_differed", outcomes.Sum(o => o.Differed));
            json.WriteNumber("events_accepted", outcomes.Sum(o => o.Accepted));
            json.WriteNumber("events_lost", outcomes.Sum(o => o.Lost));
            json.WriteNumber("copies", outcomes.Sum(o => o.Copies));
            json.WriteNumber("regained", outcomes.Sum(o => o.Regained));
            json.WriteStartObject("recovery_s");
            json.WriteNumber("p50", recovery.P50);
            json.WriteNumber("p99", recovery.P99);
            json.WriteNumber("max", recovery.Max);
            json.WriteEndObject();
            json.WriteStartArray("failing_seeds");
            foreach (StallOutcome o in outcomes.Where(o => !o.IsGood))
            {
                json.WriteNumberValue(o.Case.Seed);
            }

            json.WriteEndArray();
            json.WriteStartArray("worst");
            foreach (StallOutcome o in worst)
            {
                json.WriteStartObject();
                Begin(json, o.Case, o.Compared, o.Differed, StallsText.Replay(o.Case));
                json.WriteNumber("events_lost", o.Lost);
                json.WriteNumber("recovery_s", o.WorstSeconds);
                End(json, o.Failures, o.IsGood);
                json.WriteNumber("events_accepted", o.Accepted);
                json.WriteNumber("events_refused", o.Refused);
                json.WriteNumber("events_refused_too_late", o.RefusedTooLate);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteStartArray("processes");
            foreach (StallProcessOutcome o in played)
            {
                json.WriteStartObject();
                Begin(json, o.Case, o.Compared, o.Differed, StallsText.Replay(o.Case, hasProcesses: true));
                End(json, o.Failures, o.IsGood);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteBoolean("stopped_early", isStopped);
            json.WriteNumber("events_refused", outcomes.Sum(o => o.Refused));
            json.WriteNumber("events_refused_too_late", outcomes.Sum(o => o.RefusedTooLate));
            json.WriteNumber("events_expected", outcomes.Sum(o => o.Expected));
        });

    private static void Begin(Utf8JsonWriter json, StallCase drawn, long compared, long differed, string replay)
    {
        json.WriteNumber("seed", drawn.Seed);
        json.WriteString("case", drawn.ToString());
        json.WriteString("replay", replay);
        json.WriteNumber("states_compared", compared);
        json.WriteNumber("states_differed", differed);
    }

    private static void End(Utf8JsonWriter json, IReadOnlyList<string> failures, bool isGood)
    {
        json.WriteStartArray("failures");
        foreach (string failure in failures)
        {
            json.WriteStringValue(failure);
        }

        json.WriteEndArray();
        json.WriteBoolean("passed", isGood);
    }
}
