using LagSim.Events;
using LagSim.Handlers;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Tests.Faults;

/// <summary>Asks whether a place is in a wall with the default filter, whatever the body collides with.</summary>
internal sealed class FaultyPlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view)
    : FreePlaces(scene, bodies, timelines, view)
{
    internal override bool TryFind(int slot, in EventKey key, in ExternalEvent external, CollisionFilter filter, out Vector3D position) =>
        base.TryFind(slot, key, external, default, out position);
}
