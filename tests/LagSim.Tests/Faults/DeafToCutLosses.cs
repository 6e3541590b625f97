using LagSim.Events;
using LagSim.Motion;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Hears of losses, and not of those that a heal cuts off again.</summary>
internal sealed class DeafToCutLosses(ILossObserver listener) : ILossObserver
{
    public void OnLost(in EventKey loss, in MotionSegment last) => listener.OnLost(loss, last);

    public void OnCut(in EventKey loss)
    {
    }
}
