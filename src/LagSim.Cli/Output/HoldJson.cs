using System.Collections.Generic;
using System.IO;
using LagSim.Harness.Hands;
using LagSim.Net.Display;

namespace LagSim.Cli.Output;

/// <summary>The prediction of a hand as JSON.</summary>
internal static class HoldJson
{
    internal static void Write(TextWriter output, HandMotion motion, IReadOnlyList<PredictionError> errors, ulong seed) =>
        JsonDocumentWriter.Write(output, "hold", seed, null, null, null, json =>
        {
            json.WriteString("motion_input", motion.Name);
            json.WriteNumber("motion_s", motion.Seconds);
            json.WriteNumber("largest_acceleration_m_per_s2", motion.LargestAcceleration());
            json.WriteStartArray("prediction_error_m");
            foreach (PredictionError error in errors)
            {
                json.WriteStartObject();
                json.WriteNumber("horizon_ms", error.HorizonMilliseconds);
                json.WriteNumber("adaptive_m", error.AdaptiveMetres);
                json.WriteNumber("hold_last_m", error.HoldLastMetres);
                json.WriteNumber("velocity_m", error.VelocityMetres);
                json.WriteNumber("best_in_hindsight_m", error.BestInHindsightMetres);
                json.WriteString("best_in_hindsight", AdaptivePredictor.Candidates[error.BestCandidate]);
                json.WriteNumber("linear_bound_m", error.LinearMetres);
                json.WriteNumber("least_worst_m", error.LeastWorstMetres);
                json.WriteNumber("samples", error.Samples);
                json.WriteEndObject();
            }

            json.WriteEndArray();
        });
}
