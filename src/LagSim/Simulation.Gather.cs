using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim;

/// <content>Who takes part in an impact.</content>
public sealed partial class Simulation
{
    /// <summary>
    /// All contacts of this tick and round that share bodies with the first, and the bodies as they meet, in canonical order. Returns the
    /// seconds from the tick to the impact. Contacts that were struck in this instant already are among them if one of those is struck again.
    /// </summary>
    private double Gather(int slot, in EventKey key, out bool collapses)
    {
        bool mayCollapse = collapseRule.HasLosses && CollapseRule.MayBeStruckAgain(key) && !faults.NeverCollapses;
        Follow(slot, key, mayCollapse);
        collapses = mayCollapse && partners.Ahead.Count == 0 && collapseRule.Collapses(key.Time);
        if (mayCollapse && partners.Ahead.Count == 0 && !collapses)
        {
            Follow(slot, key, withStruckBefore: false);
        }

        if (partners.Ahead.Count > 0)
        {
            return 0;
        }

        // One instant for all: the earliest root. The others are met within a tick, so nothing is yet deep in anything.
        double residual = double.MaxValue;
        for (int i = 0; i < graph.ContactCount; i++)
        {
            residual = !graph.Contacts[i].IsFromBefore ? Math.Min(residual, graph.Contacts[i].Time.Residual) : residual;
        }

        graph.Evaluate(key.Time, residual);
        return residual;
    }

    /// <summary>
    /// Finds contacts from body to body: those that are struck and, if asked to, those that were struck earlier in this instant and still touch.
    /// It finds the same contacts whichever of the bodies it begins at, so two impacts of one round have no body in common. Bodies that merely
    /// touch are left out, because a heal would not know that they were looked at.
    /// </summary>
    private void Follow(int slot, in EventKey key, bool withStruckBefore)
    {
        graph.Clear();
        partners.Ahead.Clear();
        graph.AddBody(slot);
        for (int i = 0; i < graph.BodyCount && partners.Ahead.Count == 0; i++)
        {
            int party = graph.Slots[i];
            for (int surface = 0; surface < surfaces.Count; surface++)
            {
                bool isStruck = predictor.TryTouchSurface(party, surface, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
                if (isStruck || (withStruckBefore && collapseRule.IsStillTouching(party, surface, key.Time, out contact)))
                {
                    graph.AddContact(new ContactPoint(i, ContactPoint.Static, surface, contact) { IsFromBefore = !isStruck });
                }
            }

            foreach (int other in index.CandidatesAt(party, bodies.Spec(party).Radius, key.Time, HealAtHand != 0))
            {
                if (other == party || !timelines.IsKnown(other) || flights.AreApart(party, other, key.Time, key.Time))
                {
                    continue;
                }

                int then = view.PieceAt(other, key);
                if (then == TimelineStore.None)
                {
                    continue;
                }

                bool isStruck = predictor.TryTouchBody(party, other, then, out ContactTime contact, out uint round) && contact.Tick == key.Time && round == key.Round;
                if (isStruck || (withStruckBefore && paths.RoundAfter(then, key.Time) <= key.Round
                    && collapseRule.AreStillTouching(party, other, then, key.Time, out contact)))
                {
                    if (then != timelines.Last(other))
                    {
                        partners.Ahead.Add(other);
                        continue;
                    }

                    int j = graph.IndexOf(other);
                    if (j < 0 || j > i)
                    {
                        j = j < 0 ? graph.AddBody(other) : j;
                        bool ordered = bodies.Id(party) < bodies.Id(other) != SwapsOperands;
                        graph.AddContact(new ContactPoint(ordered ? i : j, ordered ? j : i, -1, contact) { IsFromBefore = !isStruck });
                    }
                }
            }
        }

        graph.Sort();
    }
}
