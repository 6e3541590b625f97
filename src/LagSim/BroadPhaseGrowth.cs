using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Builds the broad phase again once there are more bodies than it is made for.</summary>
internal sealed class BroadPhaseGrowth(
    BodyTable bodies, Progress progress, RollbackState rollback, AdaptiveBroadPhase broadPhase, EventPredictor predictor)
{
    /// <summary>After bodies were added: builds it again if it is outgrown, and has all bodies predicted with it.</summary>
    internal void Fit()
    {
        if (!broadPhase.IsOutgrown)
        {
            return;
        }

        broadPhase.Rebuild(progress.HistoryEdge, rollback.Cursor.Time);
        foreach (int slot in bodies)
        {
            predictor.Predict(slot);
        }
    }
}
