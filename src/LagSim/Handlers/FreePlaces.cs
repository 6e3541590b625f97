using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Decides where a spawn or a teleport puts its body if another body is there.</summary>
/// <remarks>
/// It asks every body where it is, by the segment on which that body comes to the event. So the answer may change with any late event
/// before it, also of a body that was not there: <see cref="Rollback.Rewinder"/> has such an event decided again in every heal that begins
/// before it. Cost: the number of bodies, and of a search at most a few thousand places times the bodies near.
/// </remarks>
internal sealed class FreePlaces(Scene scene, BodyTable bodies, TimelineStore timelines, SegmentLookup view)
{
    /// <summary>Each sphere of the search is half a radius wider than the one before, so the last has 32 radii.</summary>
    private const int Spheres = 64;

    private static readonly Vector3D[] Directions = MakeDirections();

    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly CollisionFilters filters = new(timelines.Extras, scene.Surfaces);
    private readonly Paths paths = new(timelines);
    private readonly List<(Vector3D Centre, double Reach)> near = new();

    /// <summary>Where an event puts a body; false if it has no effect because there is no room.</summary>
    /// <param name="slot">The body.</param>
    /// <param name="key">The event's key.</param>
    /// <param name="external">The event.</param>
    /// <param name="filter">What the body collides with.</param>
    /// <param name="position">Where its centre is put.</param>
    internal bool TryFind(int slot, in EventKey key, in ExternalEvent external, CollisionFilter filter, out Vector3D position)
    {
        position = external.Position;
        if (external.WhenOccupied == WhenOccupied.Overlap)
        {
            return true;
        }

        double radius = bodies.Spec(slot).Radius;
        FindNear(slot, key, filter, position, radius);
        if (IsFree(position, radius))
        {
            return true;
        }

        bool isFound = false;
        for (int sphere = 1; sphere <= Spheres && external.WhenOccupied == WhenOccupied.Beside && !isFound; sphere++)
        {
            for (int n = 0; n < Directions.Length && !isFound; n++)
            {
                position = scene.Box.Wrap(external.Position + (Directions[n] * (0.5 * sphere * radius))).WithoutNegativeZero();
                isFound = IsFree(position, radius) && IsAllowed(slot, position, radius, filter);
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

    /// <summary>Whether no body is at a place, but for what rounding and the scene's threshold leave of touching.</summary>
    private bool IsFree(in Vector3D position, double radius)
    {
        bool isFree = true;
        for (int n = 0; n < near.Count && isFree; n++)
        {
            (Vector3D centre, double reach) = near[n];
            double slack = scene.RestitutionThreshold + (1e-15 * (position.Taxicab + centre.Taxicab + reach));
            isFree = scene.Box.Nearest(position - centre).Length - reach >= -slack;
        }

        return isFree;
    }

    /// <summary>Whether a body may be put at a place, as the door asks it of the event's own.</summary>
    private bool IsAllowed(int slot, in Vector3D position, double radius, CollisionFilter filter)
    {
        bool isAllowed = Math.Abs(position.X) <= Limits.MaxCoordinate && Math.Abs(position.Y) <= Limits.MaxCoordinate
            && Math.Abs(position.Z) <= Limits.MaxCoordinate && !Limits.IsAtCentre(position, bodies.Spec(slot), scene.ForceArray);
        double slack = scene.RestitutionThreshold + (1e-15 * (position.Taxicab + radius));
        for (int surface = 0; surface < surfaces.Count && isAllowed; surface++)
        {
            isAllowed = !filters.MeetSurface(filter, surface) || surfaces.Gap(surface, position, radius) >= -slack;
        }

        return isAllowed;
    }
}
