using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Response;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Takes the two bodies of each contact the wrong way round.</summary>
internal sealed class FaultyImpactGraphBuilder(
    Scene scene, BodyTable bodies, TimelineStore timelines, RollbackState rollback, RewindRequests rewinds, SegmentLookup view,
    FreeFlights flights, AdaptiveBroadPhase broadPhase, CollisionPredictor predictor, CollapseRule collapse, ContactGraph graph,
    Partners partners, EventWork work, FaultyEngineParts faults)
    : ImpactGraphBuilder(scene, bodies, timelines, rollback, rewinds, view, flights, broadPhase, predictor, collapse, graph, partners, work)
{
    private readonly ContactGraph graph = graph;

    internal override bool TryBuild(int slot, in EventKey key, out double residual, out bool collapses)
    {
        bool isBuilt = base.TryBuild(slot, key, out residual, out collapses);
        if (isBuilt && faults.SwapsOperands)
        {
            foreach (ref ContactPoint contact in graph.Contacts)
            {
                bool isPair = contact.Second != ContactPoint.Static;
                (contact.First, contact.Second) = isPair ? (contact.Second, contact.First) : (contact.First, contact.Second);
            }

            graph.Sort();
        }

        return isBuilt;
    }
}
