using System.IO;
using System.Linq;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Experiments.Peers;

namespace LagSim.Cli.Output;

/// <summary>A hand that holds and throws a ball, and its prediction, as JSON.</summary>
internal static class HoldJson
{
    internal static void Write(TextWriter output, HoldReport report)
    {
        ulong? scene = RunJson.Common(report.Runs.Select(run => run.SceneHash)), state = RunJson.Common(report.Runs.SelectMany(run => run.StateHashes));
        JsonDocumentWriter.Write(output, "hold", report.Seed, "hold", scene, state, json =>
        {
            json.WriteString("motion_input", report.Motion.Name);
            json.WriteNumber("motion_s", report.Motion.Seconds);
            json.WriteNumber("largest_acceleration_m_per_s2", report.Motion.LargestAcceleration());
            json.WriteStartArray("runs");
            foreach (HoldRun run in report.Runs)
            {
                HoldRunJson.Write(json, run);
            }

            json.WriteEndArray();
            json.WriteStartArray("prediction_error_m");
            foreach (PredictionError error in report.Predictions)
            {
                PredictionErrorJson.Write(json, error);
            }

            json.WriteEndArray();
        });
    }
}
