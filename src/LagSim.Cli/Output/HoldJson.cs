using System.IO;
using System.Linq;
using System.Text.Json;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Hold;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Display;
using LagSim.Scenes;

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
                Run(json, run);
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

    private static void Run(Utf8JsonWriter json, HoldRun run)
    {
        json.WriteStartObject();
        RunJson.Setting(
            json, "hold", run.Options.Strategy, MotionNames.Of(MotionLaw.RungeKutta4), HoldTables.Time(run.Options), HoldTables.Transport(run.Options),
            run.Options.DelayMilliseconds is null ? run.Options.Link.Name : null, run.Options.DelayMilliseconds, run.Options.Peers);
        RunJson.Figures(json, run, run.CpuCoresAtRest);
        json.WriteString("truth_state_hash", JsonDocumentWriter.Hash(run.TruthStateHash));
        json.WriteString("truth_event_hash", JsonDocumentWriter.Hash(run.TruthEventHash));
        json.WriteNumber("hold_s", run.Options.HoldSeconds);
        json.WriteNumber("knot_distance_m", run.Options.KeyframeDistanceMetres);
        json.WriteNumber("knots", run.Keyframes);
        json.WriteNumber("knots_per_s", run.KeyframesPerSecond);
        json.WriteNumber("holder_bytes_sent_per_s", run.HolderSentPerSecond);
        json.WriteNumber("holder_bytes_received_per_s", run.HolderReceivedPerSecond);
        RunJson.Errors(json, "holder_error", run.Own, without: null);
        json.WriteStartArray("held_error");
        foreach (HeldView view in run.Views)
        {
            json.WriteStartObject();
            json.WriteNumber("peer", view.Peer);
            bool isMeasured = view.Predicted.Samples > 0; // the candidates are measured where their mix is
            RunJson.Errors(json, "simulated", view.Simulated, without: null);
            RunJson.Errors(json, "predicted", view.Predicted, without: null);
            JsonDocumentWriter.Number(json, "hold_last_m", isMeasured ? view.HoldLastMetres : null);
            JsonDocumentWriter.Number(json, "velocity_m", isMeasured ? view.VelocityMetres : null);
            JsonDocumentWriter.Number(json, "best_in_hindsight_m", isMeasured ? view.BestInHindsightMetres : null);
            json.WriteString("best_in_hindsight", isMeasured ? AdaptivePredictor.Candidates[view.BestCandidate] : null);
            json.WriteEndObject();
        }

        json.WriteEndArray();
        json.WriteEndObject();
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
