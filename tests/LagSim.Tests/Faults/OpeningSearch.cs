using LagSim.Collisions;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Searches for a crossing where it has searched before: it finds the last one again.</summary>
internal sealed class OpeningSearch(Scene scene, SimTime start, BodyTable bodies, TimelineStore timelines, SegmentLookup view, CrossingLog log)
    : CrossingPredictor(scene, start, bodies, timelines, view, log)
{
    private protected override SimTime SearchedFrom(int crossing, in EventKey opened) => opened.Time;
}
