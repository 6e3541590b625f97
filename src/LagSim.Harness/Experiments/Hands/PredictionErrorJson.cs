using System.Text.Json;
using LagSim.Net.Display;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>How well a hand is predicted at one delay, as JSON: the same keys from the tool and from the page.</summary>
public static class PredictionErrorJson
{
    /// <summary>Writes it.</summary>
    public static void Write(Utf8JsonWriter json, PredictionError error)
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
