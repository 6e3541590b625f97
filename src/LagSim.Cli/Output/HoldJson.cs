using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.Experiments.Peers;
using LagSim.Net.Display;

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
                Prediction(json, error);
            }

            json.WriteEndArray();
        });
    }

    private static void Prediction(Utf8JsonWriter json, PredictionError error)
    {
        json.WriteStartObject();
        json.WriteNumber("horizon_ms", error.HorizonMilliseconds);
        json.WriteNumber("adaptive_m", error.AdaptiveMetres);
        json.WriteNumber("hold_last_m", error.HoldLastMetres);
        json.WriteNumber("velocity_m", error.VelocityMetres);
        json.WriteNumber("best_in_hindsight_m", error.BestInHindsightMetres);
        json.WriteString("best_in_hindsight", AdaptivePredictor.Candidates[error.BestCandidate]);
        json.WriteNumber("linear_bound_m", error.LinearMetres);
        json.WriteNumber("least_worst_m", error.LowerBoundMetres);
        json.WriteNumber("samples", error.Samples);
        json.WriteEndObject();
    }
}
