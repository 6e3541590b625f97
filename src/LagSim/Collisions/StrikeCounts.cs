using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>
/// The number of times two bodies were struck within one instant while they did not part: the clock cannot distinguish such impacts.
/// </summary>
/// <remarks>A pure function of the segments given.</remarks>
internal sealed class StrikeCounts(TimelineStore timelines, BodyTable bodies, StaticSurfaces surfaces, PeriodicBox box)
{
    /// <summary>
    /// A contact that was struck twice in an instant and closes again slower than this, in m/s, waits for <see cref="ContactTime.Soon"/>.
    /// One that parts slower than this may as well count as closing: rounding decides.
    /// </summary>
    internal const double CollapseSpeed = 1e-6;

    private readonly Paths paths = new(timelines);
    private readonly StrikeTable known = new();

    /// <summary>
    /// How many impacts of this instant were on a body while it did not part from a surface that it touches; two where it is more.
    /// </summary>
    internal int On(int piece, int surface, SimTime time)
    {
        if (timelines.Key(piece).Time != time)
        {
            return 0;
        }

        ref StrikeTable.Entry last = ref known.Find(timelines.Owner(piece), ~surface, time);
        ContactTime tick = ContactTime.At(time);
        int at = piece;
        int strikes = 0;
        while (strikes < 2 && timelines.Key(at).Time == time && timelines.Previous(at) != TimelineStore.None)
        {
            if (last.First == timelines.Serial(at))
            {
                strikes += last.Strikes;
                break;
            }

            bool isImpact = timelines.Key(at).Kind == EventKind.Impact;
            at = timelines.Previous(at);
            strikes += isImpact && ClosesOn(at, surface, tick) ? 1 : 0;
        }

        last.Note(timelines.Serial(piece), ~surface, Math.Min(strikes, 2));
        return last.Strikes;
    }

    /// <summary>
    /// How many impacts of this instant were on two bodies that touch, while they did not part from each other; two where it is more.
    /// </summary>
    internal int Between(int first, int second, SimTime time)
    {
        if (timelines.Key(first).Time != time || timelines.Key(second).Time != time)
        {
            return 0;
        }

        if (bodies.Id(timelines.Owner(first)) > bodies.Id(timelines.Owner(second)))
        {
            (first, second) = (second, first);
        }

        ref StrikeTable.Entry last = ref known.Find(timelines.Owner(first), timelines.Owner(second), time);
        ContactTime tick = ContactTime.At(time);
        int a = first;
        int b = second;
        int strikes = 0;
        while (strikes < 2 && timelines.Key(a).Time == time && timelines.Key(b).Time == time
            && timelines.Previous(a) != TimelineStore.None && timelines.Previous(b) != TimelineStore.None)
        {
            if (last.First == timelines.Serial(a) && last.Second == timelines.Serial(b))
            {
                strikes += last.Strikes;
                break;
            }

            int order = EventKey.Compare(timelines.Key(a), timelines.Key(b));
            bool isImpact = order == 0 && timelines.Key(a).Kind == EventKind.Impact;
            a = order >= 0 ? timelines.Previous(a) : a;
            b = order <= 0 ? timelines.Previous(b) : b;
            strikes += isImpact && Close(a, b, tick) ? 1 : 0;
        }

        last.Note(timelines.Serial(first), timelines.Serial(second), Math.Min(strikes, 2));
        return last.Strikes;
    }

    private bool ClosesOn(int piece, int surface, in ContactTime tick) =>
        Vector3D.Dot(surfaces.Normal(surface, paths.PositionAt(piece, tick)), paths.VelocityAt(piece, tick)) <= CollapseSpeed;

    private bool Close(int a, int b, in ContactTime tick)
    {
        Vector3D normal = box.Nearest(paths.PositionAt(a, tick) - paths.PositionAt(b, tick)).Direction;
        return Vector3D.Dot(normal, paths.VelocityAt(a, tick) - paths.VelocityAt(b, tick)) <= CollapseSpeed;
    }
}
