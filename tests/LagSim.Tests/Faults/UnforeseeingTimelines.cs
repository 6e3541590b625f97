using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Timelines that do not foretell how much room they will need, and so grow by little.</summary>
internal sealed class UnforeseeingTimelines(SimTime origin, int most, INewestSegments newest, int expected, SimDuration history)
    : TimelineStore(origin, most, newest, expected, history)
{
    private protected override int Expected(SimTime now, int recent) => 0;
}
