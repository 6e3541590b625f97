using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>Handles impacts: finds the bodies that take part, solves the impact and opens the segments that follow.</summary>
internal sealed class ImpactHandler(
    Scene scene, BodyTable bodies, ContactGraph graph, Partners partners, IsolatedImpact isolated, ImpactGraphBuilder builder,
    FreeImpactResponse resolver, IslandImpact island, ImpactNotifier notifier, ImpactSegments segments, SegmentLinker linker)
{
    /// <summary>
    /// The number of rounds of impacts beyond which an instant counts as endless. Only elastic impacts get there, because all others
    /// collapse. The longest series that end, 3,141,592 impacts of two balls and a wall, have a few in each instant.
    /// </summary>
    private const uint MaxRounds = 1 << 16;

    /// <summary>Opens the segments after an impact; the graph then has their bodies. False if a body has to be rewound first.</summary>
    /// <exception cref="InstantException">The instant does not end.</exception>
    internal bool TryHandle(int slot, in EventKey key)
    {
        if (isolated.TryHandle(slot, key))
        {
            return true;
        }

        if (key.Round >= MaxRounds)
        {
            throw Endless(slot, key.Time);
        }

        if (!builder.TryBuild(slot, key, out double residual, out bool collapses))
        {
            return false;
        }

        resolver.SetTargets(collapses, key.Time);
        partners.NearMisses.Clear();
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
        resolver.Resolve(collapses);
        for (int i = 0; i < graph.BodyCount; i++)
        {
            segments.Open(i, key, residual);
        }
    }

    private InstantException Endless(int slot, SimTime time) => new(
        $"At {time.ToShortString()} the impacts of {scene.Describe(bodies.Id(slot))} have no end: {MaxRounds} in one instant. What is squeezed between others and loses no energy is struck for ever:"
        + " give it, or what squeezes it, a restitution below 1, a mass that is less unlike, or room.", time);
}
