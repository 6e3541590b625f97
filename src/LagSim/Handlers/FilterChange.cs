using System;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Handlers;

/// <summary>Opens a segment on which a body goes on as it moves, but with another collision filter.</summary>
/// <remarks>
/// The filter is the segment's, so a rollback that cuts the segment takes it back. What no longer collides with the body lets it go: a
/// plane that carried it at once, a body of its island at the next contact step. A body that is now inside of static geometry that stops it
/// is put outside of it, as one that a hand releases there; where there is no room outside, the filter stays. Two bodies inside of each
/// other are pushed apart, as where one was put into the other.
/// </remarks>
internal sealed class FilterChange(Scene scene, BodyTable bodies, TimelineStore timelines, MemberFactory members, TrajectoryFactory trajectories)
{
    private readonly CollisionFilters filters = new(timelines.Extras, scene.Surfaces);
    private readonly Paths paths = new(timelines);
    private readonly Clearance clearance = new(scene);
    private readonly StaticSurfaces surfaces = scene.Surfaces;

    /// <summary>Has a body that is there collide by another filter from the key on. Nothing is opened if it has that filter.</summary>
    internal void Open(int slot, in EventKey key, CollisionFilter filter)
    {
        int last = timelines.Last(slot);
        CollisionFilter before = timelines.Extras.Filter(last);
        if (before == filter)
        {
            return;
        }

        double seconds = paths.SecondsInto(last, key.Time);
        Vector3D position = timelines.Segment(last).PositionAt(seconds, timelines.Dense(last));
        Vector3D velocity = timelines.Segment(last).VelocityAt(seconds, timelines.Dense(last));
        Vector3D spin = timelines.SpinOf(last).At(seconds);
        if (paths.IsHeld(last))
        {
            timelines.Extras.OpenWith(filter);
            trajectories.Hands.GoOn(slot, key);
            return;
        }

        double radius = bodies.Spec(slot).Radius;
        bool staysMember = paths.IsMember(last) && !IsInNew(position, radius, filter, before, scene.ContactTolerance);
        Vector3D outside = position;
        if (!staysMember && !clearance.TryPutOut(position, radius, filter, out outside))
        {
            return; // what is to stop it leaves it no room
        }

        timelines.Extras.OpenWith(filter);
        if (staysMember)
        {
            if (members.TryGoOn(slot, key, position, velocity, spin, hasChanged: true))
            {
                timelines.EndMember(timelines.Last(slot), bodies.Id(slot));
            }
        }
        else
        {
            Span<int> carriers = stackalloc int[SupportSet.Most];
            int count = 0;
            SupportSet supports = timelines.Segment(last).Supports;
            for (int k = 0; k < supports.Count && !IsWider(filter, before); k++)
            {
                if (filters.MeetSurface(filter, supports[k]))
                {
                    carriers[count++] = supports[k];
                }
            }

            trajectories.Open(slot, key, outside, velocity, 0, carriers.Slice(0, count), spin);
        }
    }

    /// <summary>Whether a body is deeper than so much inside of a surface that stops it by a filter, and did not by the one before.</summary>
    private bool IsInNew(in Vector3D position, double radius, CollisionFilter filter, CollisionFilter before, double depth)
    {
        bool isInside = false;
        for (int surface = 0; surface < surfaces.Count && !isInside; surface++)
        {
            isInside = filters.MeetSurface(filter, surface) && !filters.MeetSurface(before, surface)
                && surfaces.Gap(surface, position, radius) < -depth;
        }

        return isInside;
    }

    /// <summary>
    /// Whether there may be something that collides with a filter and did not with the one before. Such a body is asked again what it
    /// touches, as one that was put there: two that rest are not tested against each other.
    /// </summary>
    private static bool IsWider(CollisionFilter filter, CollisionFilter before) =>
        (filter.Category & ~before.Category) != 0 || (filter.Mask & ~before.Mask) != 0;
}
