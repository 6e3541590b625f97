using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Play;

/// <summary>The paths of the bodies of a world, as points of a line: evenly in time, and at each bounce if asked.</summary>
/// <remarks>Costs a look into the timelines for every point, so it is for when somebody asks.</remarks>
internal static class PathSampler
{
    /// <summary>How many bounces there may be between two evenly spaced instants: a heap has thousands a second.</summary>
    private const int Corners = 2;

    /// <summary>Appends a body's path.</summary>
    /// <param name="world">The world.</param>
    /// <param name="scene">Where a place is drawn.</param>
    /// <param name="body">The body.</param>
    /// <param name="span">From when to when, within the window.</param>
    /// <param name="now">The moment that times are told from.</param>
    /// <param name="points">How many instants there are evenly spaced, both ends included, 2 or more; and whether bounces are points too,
    /// which cost a copy of the body's timeline, which is much for a heap.</param>
    /// <param name="into">Gets the number of points, then for each the time in seconds from <paramref name="now"/>, and x and y in metres
    /// of the view. A point whose x and y are not a number breaks the line: the body is not there, or was put elsewhere.</param>
    internal static void Append(
        Simulation world, PlayScene scene, BodyId body, (SimTime Oldest, SimTime Newest) span, SimTime now,
        (int Count, bool WithBounces) points, List<double> into)
    {
        int count = points.Count;
        SimTime oldest = SimTime.Max(span.Oldest, world.HistoryEdge), newest = SimTime.Min(span.Newest, world.Horizon);
        long ticks = (newest - oldest).Ticks, least = ticks / (Corners * count);
        int head = into.Count, told = 0, next = 0;
        into.Add(0);
        SimTime last = oldest;
        foreach (TimelineEntry entry in points.WithBounces ? world.Timeline(body, oldest) : [])
        {
            SimTime time = entry.Key.Time;
            bool isBreak = entry.Key.Kind is EventKind.Teleport or EventKind.Grab;
            bool isSeen = isBreak || (entry.Key.Kind != EventKind.StepEnd && (time - last).Ticks >= least);
            if (time <= oldest || time >= newest || !isSeen)
            {
                continue; // the end of a step bends nothing, and what follows a bounce at once is not seen
            }

            AddEvenlyUntil(time);
            if (isBreak)
            {
                Add(time, double.NaN, double.NaN);
            }

            Read(time);
            last = time;
        }

        AddEvenlyUntil(newest + SimDuration.OneTick);
        into[head] = told;

        void AddEvenlyUntil(SimTime end)
        {
            for (; next < count && EvenlyAt(next) < end; next++)
            {
                Read(EvenlyAt(next));
            }
        }

        SimTime EvenlyAt(int n) => oldest + SimDuration.FromTicks((long)((double)ticks * n / (count - 1)));

        void Read(SimTime time)
        {
            bool isThere = world.TryRead(body, time, out BodyState state);
            (double x, double y) = isThere ? scene.ToView(state.Position) : (double.NaN, double.NaN);
            Add(time, x, y);
        }

        void Add(SimTime time, double x, double y)
        {
            told++;
            into.Add((time - now).ToSeconds());
            into.Add(x);
            into.Add(y);
        }
    }
}
