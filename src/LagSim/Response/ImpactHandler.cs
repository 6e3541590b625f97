using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;

namespace LagSim.Response;

/// <summary>Handles impacts: finds the bodies that take part, solves the impact and opens the segments that follow.</summary>
internal sealed class ImpactHandler(
    ContactGraph graph, Partners partners, IsolatedImpact isolated, ImpactGraphBuilder builder, ImpactCrowd crowd,
    FreeImpactResponse resolver, IslandImpact island, ImpactNotifier notifier, ImpactSegments segments, SegmentLinker linker, ClosedInstants closed)
{
    /// <summary>Opens the segments after an impact; the graph then has their bodies. False if a body has to be rewound first.</summary>
    internal bool TryHandle(int slot, in EventKey key)
    {
        if (isolated.TryHandle(slot, key))
        {
            return true;
        }

        partners.NearMisses.Clear();
        if (!builder.TryBuild(slot, key, out double residual, out bool collapses))
        {
            return false;
        }

        crowd.LeaveOut();
        resolver.SetTargets(collapses, key);
        closed.IsOpen = collapses && CollapseRule.IsLong(key);
        EventKey canonical = graph.CanonicalKey(key);
        ImpactOutcome outcome = graph.HasHand() ? island.Handle(canonical, residual, presses: true) : ImpactOutcome.GivesWay;
        if (outcome == ImpactOutcome.GivesWay && island.Reaches(canonical.Time))
        {
            outcome = island.Handle(canonical, residual, presses: false);
        }

        if (outcome == ImpactOutcome.NeedsRewind)
        {
            return false;
        }

        if (outcome == ImpactOutcome.GivesWay)
        {
            Solve(canonical, residual, collapses);
        }

        linker.Join(canonical);
        return true;
    }

    private void Solve(in EventKey key, double residual, bool collapses)
    {
        notifier.Tell(key);
        closed.Before();
        resolver.Resolve(collapses);
        closed.After();
        for (int i = 0; i < graph.BodyCount; i++)
        {
            segments.Open(i, key, residual);
        }
    }
}
