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
/// plane that carried it at once, a body of its island at the next contact step. A body that is now inside of a static surface that it
/// collides with is put outside of it, as one that a hand releases there; two bodies inside of each other are pushed apart, as where one
/// was put into the other.
/// </remarks>
internal sealed class FilterChange(Scene scene, BodyTable bodies, TimelineStore timelines, MemberFactory members, TrajectoryFactory trajectories)
{
    private readonly CollisionFilters filters = new(timelines.Extras, scene.Surfaces);
    private readonly Paths paths = new(timelines);

    /// <summary>Has a body that is there collide by another filter from the key on. Nothing is opened if it has that filter.</summary>
    internal void Open(int slot, in EventKey key, CollisionFilter filter)
    {
        int last = timelines.Last(slot);
        CollisionFilter before = timelines.Extras.Filter(last);
        if (before == filter)
        {
            return;
        }

        timelines.Extras.OpenWith(filter);
        double seconds = paths.SecondsInto(last, key.Time);
        Vector3D position = timelines.Segment(last).PositionAt(seconds, timelines.Dense(last));
        Vector3D velocity = timelines.Segment(last).VelocityAt(seconds, timelines.Dense(last));
        Vector3D spin = timelines.SpinOf(last).At(seconds);
        if (paths.IsHeld(last))
        {
            trajectories.Hands.GoOn(slot, key);
        }
        else if (paths.IsMember(last))
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

            trajectories.Open(slot, key, trajectories.Hands.PutOut(slot, position, filter), velocity, 0, carriers.Slice(0, count), spin);
        }
    }

    /// <summary>
    /// Whether there may be something that collides with a filter and did not with the one before. Such a body is asked again what it
    /// touches, as one that was put there: two that rest are not tested against each other.
    /// </summary>
    private static bool IsWider(CollisionFilter filter, CollisionFilter before) =>
        (filter.Category & ~before.Category) != 0 || (filter.Mask & ~before.Mask) != 0;
}
