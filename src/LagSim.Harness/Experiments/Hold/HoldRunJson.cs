using System.Text.Json;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.Reports;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Display;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>One session with a hand as JSON: the same keys from the tool and from the page.</summary>
public static class HoldRunJson
{
    /// <summary>Writes it.</summary>
    public static void Write(Utf8JsonWriter json, HoldRun run)
    {
        json.WriteStartObject();
        RunJson.Setting(
            json, "hold", run.Options.Strategy, MotionNames.Of(MotionLaw.RungeKutta4),
            run.Options.IsVirtual ? "virtual" : "real", run.Options.IsVirtual ? "virtual" : run.Options.Carrier.Name,
            run.Options.DelayMilliseconds is null ? run.Options.Link.Name : null, run.Options.DelayMilliseconds, run.Options.Peers);
        RunJson.Figures(json, run, run.CpuCoresAtRest);
        json.WriteString("truth_state_hash", JsonValues.Hash(run.TruthStateHash));
        json.WriteString("truth_event_hash", JsonValues.Hash(run.TruthEventHash));
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
            JsonValues.Number(json, "hold_last_m", isMeasured ? view.HoldLastMetres : null);
            JsonValues.Number(json, "velocity_m", isMeasured ? view.VelocityMetres : null);
            JsonValues.Number(json, "best_in_hindsight_m", isMeasured ? view.BestInHindsightMetres : null);
            json.WriteString("best_in_hindsight", isMeasured ? AdaptivePredictor.Candidates[view.BestCandidate] : null);
            json.WriteEndObject();
        }

        json.WriteEndArray();
        json.WriteEndObject();
    }
}
