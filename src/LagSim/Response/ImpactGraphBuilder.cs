using System;
using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>
/// Builds the contact graph of an impact: all contacts of its tick and round that share bodies, and the bodies as they meet.
/// </summary>
internal class ImpactGraphBuilder(
    Scene scene, BodyTable bodies, TimelineStore timelines, RollbackState rollback, RewindRequests rewinds, SegmentLookup view,
    FreeFlights flights, AdaptiveBroadPhase broadPhase, CollisionPredictor predictor, CollapseRule collapse, ContactGraph graph, Partners partners, EventWork work)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly Paths paths = new(timelines);

    /// <summary>
    /// Builds the graph, in canonical order. Contacts that were struck in this instant already are among them if one of those is struck
    /// again. False if a body that takes part is ahead and has to be rewound first.
    /// </summary>
    /// <param name="slot">A body of the impact.</param>
    /// <param name="key">The impact.</param>
    /// <param name="residual">Seconds from the tick to the impact.</param>
    /// <param name="collapses">Whether it ends a collapse (docs/CONTACT.md).</param>
    internal virtual bool TryBuild(int slot, in EventKey key, out double residual, out bool collapses)
    {
        residual = double.MaxValue;
        bool mayCollapse = (collapse.HasLosses && CollapseRule.MayBeStruckAgain(key)) || CollapseRule.IsLong(key);
        Follow(slot, key, mayCollapse);
        bool askedAll = false;
        collapses = mayCollapse && rewinds.AreNone && collapse.Collapses(key, out askedAll);
        if (mayCollapse && rewinds.AreNone && !collapses)
        {
            // That there is none depends on all of them: what changes one of them later may bring the collapse about.
            foreach (int asked in askedAll ? graph.Slots : default)
            {
                partners.NearMisses.Add(asked);
            }

            Follow(slot, key, withStruckBefore: false);
        }

        if (!rewinds.AreNone)
        {
            return false;
        }

        // One instant for all: the earliest root. The others are met within a tick, so nothing is yet deep in anything.
        for (int i = 0; i < graph.ContactCount; i++)
        {
            residual = !graph.Contacts[i].IsFromBefore ? Math.Min(residual, graph.Contacts[i].Time.Residual) : residual;
        }

        graph.Evaluate(key.Time, residual);
        return true;
    }

    /// <summary>
    /// Finds contacts from body to body: those that are struck and, if asked to, those that were struck earlier in this instant and still
    /// touch. It finds the same contacts whichever of the bodies it begins at, so two impacts of one round have no body in common. Bodies
    /// that merely touch are left out, because a rollback would not know that they were tested.
    /// </summary>
    private void Follow(int slot, in EventKey key, bool withStruckBefore)
    {
        graph.Clear();
        graph.AddBody(slot);
        for (int i = 0; i < graph.BodyCount && rewinds.AreNone; i++)
        {
            FindSurfaces(i, key, withStruckBefore);
            FindBodies(i, key, withStruckBefore);
        }

        graph.Sort();
    }

    private void FindSurfaces(int body, in EventKey key, bool withStruckBefore)
    {
        int slot = graph.Slots[body];
        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            bool isStruck = predictor.TryTouchSurface(slot, surface, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
            if (isStruck || (withStruckBefore && collapse.IsStillTouching(slot, surface, key.Time, out contact)))
            {
                graph.AddContact(new ContactPoint(body, ContactPoint.Static, surface, contact) { IsFromBefore = !isStruck });
            }
        }
    }

    private void FindBodies(int body, in EventKey key, bool withStruckBefore)
    {
        int slot = graph.Slots[body];
        bool isHealing = rollback.MayBeKnownBeyond(rollback.Cursor);
        Span<int> candidates = broadPhase.Current.CandidatesAt(slot, bodies.Spec(slot).Radius, key.Time, isHealing);
        work.CountCandidates(candidates.Length);
        foreach (int other in candidates)
        {
            int known = graph.IndexOf(other);
            bool wasTested = known >= 0 && known <= body; // from the other one
            int piece = wasTested || !timelines.IsKnown(other) ? TimelineStore.None : view.SegmentAt(other, key);
            if (piece == TimelineStore.None || (piece == timelines.Last(other) && flights.AreApart(slot, other, key.Time, key.Time)))
            {
                continue;
            }

            bool isStruck = predictor.TryTouchBody(slot, other, piece, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
            if (!isStruck && !(withStruckBefore && paths.RoundAfter(piece, key.Time) <= key.Round
                && collapse.AreStillTouching(slot, other, piece, key.Time, out contact)))
            {
                continue;
            }

            if (piece != timelines.Last(other))
            {
                rewinds.Add(other, EventKey.BeforeImpacts(key.Time, key.Round));
                continue;
            }

            known = known < 0 ? graph.AddBody(other) : known;
            bool ordered = bodies.Id(slot) < bodies.Id(other);
            graph.AddContact(new ContactPoint(ordered ? body : known, ordered ? known : body, -1, contact) { IsFromBefore = !isStruck });
        }
    }
}
