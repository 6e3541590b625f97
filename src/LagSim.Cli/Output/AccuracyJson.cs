using System.IO;
using LagSim.Harness.Experiments.Accuracy;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Cli.Output;

/// <summary>Speed against error as a JSON document.</summary>
internal static class AccuracyJson
{
    internal static void Write(TextWriter output, AccuracyReport report)
    {
        WorkScene? only = report.Scenes.Count == 1 ? report.Scenes[0] : null;
        JsonDocumentWriter.Write(output, "accuracy", report.Seed, only?.Name, only?.Scene.Hash, null, json =>
        {
            json.WriteBoolean("quick", report.IsQuick);
            json.WriteString("clock", ThreadClock.Name);
            json.WriteStartArray("points");
            foreach (WorkPoint point in report.Work.Points)
            {
                json.WriteStartObject();
                json.WriteString("scene", point.Scene);
                json.WriteString("method", point.Method);
                json.WriteString("setting", point.Setting);
                JsonDocumentWriter.Number(json, "step_s", point.StepSeconds);
                JsonDocumentWriter.Number(json, "error", point.Error);
                json.WriteString("error_kind", point.ErrorKind);
                json.WriteNumber("cpu_s", point.CpuSeconds);
                json.WriteNumber("runs", point.Runs);
                json.WriteNumber("simulated_s", point.SimulatedSeconds);
                json.WriteNumber("events", point.Events);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            json.WriteStartObject("orders");
            foreach (WorkOrder order in report.Work.Orders)
            {
                JsonDocumentWriter.Number(json, report.NameOf(order), order.Slope);
            }

            json.WriteEndObject();
            json.WriteStartArray("spread");
            foreach (WorkSpread spread in report.Spread)
            {
                json.WriteStartObject();
                json.WriteString("method", spread.Method);
                json.WriteString("setting", spread.Setting);
                json.WriteString("error_kind", spread.ErrorKind);
                json.WriteNumber("scenes", spread.Scenes);
                Numbers("error", spread.Error);
                Numbers("simulated_s_per_cpu_s", spread.Speed);
                json.WriteEndObject();
            }

            json.WriteEndArray();
            Sentences("findings", WorkFindings.Sentences(report.Work.Points));
            Sentences("left_out", report.Work.LeftOut);
            json.WriteString("caution", WorkFindings.Caution);
            json.WriteBoolean("stopped_early", report.Work.StoppedAt is not null);
            json.WriteString("stopped_at", report.Work.StoppedAt);

            void Numbers(string key, SpreadOf of)
            {
                json.WriteStartObject(key);
                JsonDocumentWriter.Number(json, "min", of.Least);
                JsonDocumentWriter.Number(json, "median", of.Median);
                JsonDocumentWriter.Number(json, "max", of.Greatest);
                json.WriteEndObject();
            }

            void Sentences(string key, System.Collections.Generic.IReadOnlyList<string> sentences)
            {
                json.WriteStartArray(key);
                foreach (string sentence in sentences)
                {
                    json.WriteStringValue(sentence);
                }

                json.WriteEndArray();
            }
        });
    }
}
