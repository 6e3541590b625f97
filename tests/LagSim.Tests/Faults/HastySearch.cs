using LagSim.Collisions;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>A search that takes bodies for apart wherever it has to look at more than the newest segment of the other one.</summary>
internal sealed class HastySearch(
    BodyTable bodies, TimelineStore timelines, FreeFlights flights, StaticSurfaces surfaces, CollisionPredictor predictor, SegmentLookup view,
    StepMarks stepMarks, EventWork work)
    : CollisionSearch(bodies, timelines, flights, surfaces, predictor, view, stepMarks, work)
{
    private readonly TimelineStore timelines = timelines;

    private protected override bool StayApart(int slot, int other, int piece, SimTime until) =>
        piece != timelines.Last(other) || base.StayApart(slot, other, piece, until);
}
