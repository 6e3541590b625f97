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
    /// <summary>Each sphere of the search is half a radius wider than the one before, so the last has 32 radii.</summary>
    private const int Spheres = 64;

    private static readonly Vector3D[] Directions = MakeDirections();

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
            position = scene.Box.Wrap(clearance.PutOut(position, spec.Radius, filter)).WithoutNegativeZero();
            isAdmitted = clearance.Admits(position, spec, filter);
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
        for (int sphere = 1; sphere <= Spheres && external.WhenOccupied == WhenOccupied.Beside && !isFound; sphere++)
        {
            for (int n = 0; n < Directions.Length && !isFound; n++)
            {
                position = scene.Box.Wrap(middle + (Directions[n] * (0.5 * sphere * spec.Radius))).WithoutNegativeZero();
                isFound = IsFree(position) && clearance.Admits(position, spec, filter);
            }
        }

        return isFound;
    }

    private static Vector3D[] MakeDirections()
    {
        List<Vector3D> directions = new();
        foreach (int y in new[] { 0, 1, -1 })
        {
            for (int x = 1; x >= -1; x--)
            {
                for (int z = 1; z >= -1; z--)
                {
                    if (x != 0 || y != 0 || z != 0)
                    {
                        directions.Add(new Vector3D(x, y, z).Direction);
                    }
                }
            }
        }

        return directions.ToArray();
    }

    /// <summary>Finds the bodies that may be in the way, as they come to the event, in canonical order.</summary>
    private void FindNear(int slot, in EventKey key, CollisionFilter filter, in Vector3D position, double radius)
    {
        near.Clear();
        double range = 0.5 * (Spheres + 1) * radius;
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
