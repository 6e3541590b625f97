using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Rollback;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Leaves those asleep that sleep on what a late event moved.</summary>
internal sealed class FaultySleepWaker(
    BodyTable bodies, TimelineStore timelines, FaultySegmentLookup view, ContactGraph graph, RewindRequests rewinds, MemberFactory members,
    FaultyEngineParts faults)
    : SleepWaker(bodies, timelines, view, graph, rewinds, members)
{
    private readonly RollbackState rollback = view.Rollback;
    private readonly ContactGraph graph = graph;

    internal override void Wake(int slot, in EventKey key)
    {
        if (faults.Has(HealingFault.LeavesSleepers) && rollback.MayBeKnownBeyond(key))
        {
            graph.Clear();
        }

        base.Wake(slot, key);
    }
}
