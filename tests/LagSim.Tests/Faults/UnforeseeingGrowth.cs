using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Does not foretell how much room timelines will need, so that they grow by little.</summary>
internal sealed class UnforeseeingGrowth(SimTime origin, SimDuration history) : TimelineGrowthPolicy(origin, history)
{
    private protected override int Expected(int room, int bodies, SimTime now, SimTime edge, int recent) => 0;
}
