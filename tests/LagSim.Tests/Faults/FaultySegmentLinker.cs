using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Does not tell who was looked at, or does not have the segments of one event cut together.</summary>
internal sealed class FaultySegmentLinker(
    BodyTable bodies, TimelineStore timelines, ContactGraph graph, Partners partners, MemberFactory members, FaultyEngineParts faults)
    : SegmentLinker(bodies, timelines, graph, partners, members)
{
    private readonly TimelineStore timelines = timelines;
    private readonly ContactGraph graph = graph;

    internal override void Join(in EventKey key)
    {
        if (!faults.Has(HealingFault.ForgetsNearMisses))
        {
            AddNearMisses(key);
        }

        if (!faults.Has(HealingFault.CutsMembersAlone))
        {
            timelines.Join(graph.Slots);
        }
    }
}
