using LagSim.Events;
using LagSim.Motion;

namespace LagSim.Timelines;

/// <summary>
/// Notified of every loss of a body that is added to the timelines and of every one that is cut off again. Called on the thread that
/// advances; it may change nothing.
/// </summary>
/// <remarks>
/// A heal that puts back what it had cut adds it again. So only what a heal leaves at its end counts: a loss that was cut and added again
/// has never been away.
/// </remarks>
internal interface ILossObserver
{
    /// <summary>A body leaves the world, because it cannot be followed any further.</summary>
    /// <param name="loss">The event.</param>
    /// <param name="last">The segment that the body leaves with: it has the body's last state.</param>
    void OnLost(in EventKey loss, in MotionSegment last);

    /// <summary>A loss is cut off: it no longer happens, unless it is reported again.</summary>
    void OnCut(in EventKey loss);
}
