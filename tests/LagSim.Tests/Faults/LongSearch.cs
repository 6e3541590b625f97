using System;
using LagSim.Collisions;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>
/// A search that takes no shortcut: it looks at the paths of all candidates, also of bodies in free flight and of one contact step.
/// </summary>
internal sealed class LongSearch(
    BodyTable bodies, TimelineStore timelines, FreeFlights flights, StaticSurfaces surfaces, CollisionPredictor predictor)
    : CollisionSearch(bodies, timelines, flights, surfaces, predictor, new StepMarks())
{
    internal override void FindInFlight(int slot, Span<int> candidates, SimTime from, SimTime until, ref NextEvent next) =>
        FindAlong(slot, candidates, from, until, ref next);
}
