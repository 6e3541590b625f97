using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Response;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Ends no collapse, or takes in whoever touches, struck or not.</summary>
internal sealed class FaultyCollapseRule(
    Scene scene, BodyTable bodies, TimelineStore timelines, ContactGraph graph, StrikeCounts strikes, FaultyEngineParts faults)
    : CollapseRule(scene, bodies, timelines, graph, strikes)
{
    internal override bool Collapses(in EventKey key, out bool askedAll) => base.Collapses(key, out askedAll) && !faults.NeverCollapses;

    private protected override bool TakesIn(int strikeCount) =>
        faults.Has(HealingFault.CollapsesWithWhoTouches) || base.TakesIn(strikeCount);
}
