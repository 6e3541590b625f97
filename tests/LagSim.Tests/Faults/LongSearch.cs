using System;
using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>
/// A search that takes no shortcut: it looks for the contact with every path of all candidates, also of bodies in free flight, of one
/// contact step, and of those that surely stay apart.
/// </summary>
internal sealed class LongSearch(
    BodyTable bodies, TimelineStore timelines, FreeFlights flights, StaticSurfaces surfaces, CollisionPredictor predictor, SegmentLookup view,
    EventWork work)
    : CollisionSearch(bodies, timelines, flights, surfaces, predictor, view, new StepMarks(), work)
{
    internal override void FindInFlight(int slot, Span<int> candidates, SimTime from, SimTime until, ref NextEvent next) =>
        FindAlong(slot, candidates, from, until, ref next);

    private protected override bool StayApart(int slot, int other, int piece, SimTime until) => false;
}
