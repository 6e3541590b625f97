using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Decides where a spawn or a teleport puts its body: outside of static geometry that stops it, and with regard to bodies.</summary>
/// <remarks>
/// Static geometry is asked with the filter that the body has at that instant: what changes it cuts the body's path before the event, which
/// is then decided again. Of other bodies it asks every body where it is, by the segment on which that body comes to the event. So the answer may change with any late event
/// before it, also of a body that was not there: <see cref="Rollback.Rewinder"/> has such an event decided again in every heal that begins
/// before it. Cost: the number of bodies, and of a search at most a few thousand places times the bodies near.
/// </remarks>
internal class FreePlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view)
{
    private readonly Clearance clearance = new(scene);
    private readonly Paths paths = new(timelines);
    private readonly List<(Vector3D Centre, double Reach)> near = new();

    /// <summary>Where an event puts a body; false if it has no effect because there is no room. An event that puts it nowhere leaves it
    /// where it is.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="key">The event's key.</param>
    /// <param name="external">The event.</param>
    /// <param name="filter">What the body collides with at that instant.</param>
    /// <param name="position">Where its centre is put.</param>
    internal virtual bool TryFind(int slot, in EventKey key, in ExternalEvent external, CollisionFilter filter, out Vector3D position)
    {
        position = external.Position;
        if (external.Kind is not (EventKind.Spawn or EventKind.Teleport))
        {
            return true;
        }

        BodySpec spec = bodies.Spec(slot);
        bool isAdmitted = clearance.Admits(position, spec, filter);
        if (external.WhenOccupied != WhenOccupied.Skip && !isAdmitted)
        {
            isAdmitted = clearance.TryPutOut(position, spec.Radius, filter, out position);
            position = scene.Box.Wrap(position).WithoutNegativeZero();
            isAdmitted = isAdmitted && clearance.Admits(position, spec, filter);
        }

        if (external.WhenOccupied == WhenOccupied.Overlap)
        {
            return isAdmitted;
        }

        FindNear(slot, key, filter, position, spec.Radius);
        if (isAdmitted && IsFree(position))
        {
            return true;
        }

        bool isFound = false;
        Vector3D middle = position;
        for (int n = 0; n < PlacesAround.Count && external.WhenOccupied == WhenOccupied.Beside && !isFound; n++)
        {
            position = scene.Box.Wrap(PlacesAround.At(n, middle, spec.Radius)).WithoutNegativeZero();
            isFound = IsFree(position) && clearance.Admits(position, spec, filter);
        }

        return isFound;
    }

    /// <summary>Finds the bodies that may be in the way, as they come to the event, in canonical order.</summary>
    private void FindNear(int slot, in EventKey key, CollisionFilter filter, in Vector3D position, double radius)
    {
        near.Clear();
        double range = PlacesAround.Range(radius);
        foreach (int other in bodies)
        {
            int piece = other == slot ? TimelineStore.None : view.SegmentBefore(other, key);
            if (piece == TimelineStore.None || !timelines.Segment(piece).IsPresent || !filter.CollidesWith(timelines.Extras.Filter(piece)))
            {
                continue;
            }

            double reach = radius + bodies.Spec(other).Radius;
            Vector3D centre = scene.Box.Wrap(paths.PositionAt(piece, key.Time));
            if (scene.Box.Nearest(centre - position).Length <= reach + range)
            {
                near.Add((centre, reach));
            }
        }
    }

    /// <summary>Whether no body is at a place.</summary>
    private bool IsFree(in Vector3D position)
    {
        bool isFree = true;
        for (int n = 0; n < near.Count && isFree; n++)
        {
            isFree = clearance.AreApart(position, near[n].Centre, near[n].Reach);
        }

        return isFree;
    }
}
