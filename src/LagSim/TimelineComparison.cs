using System;
using System.Collections.Generic;
using System.Globalization;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Compares the timelines of two worlds, bit for bit.</summary>
internal static class TimelineComparison
{
    /// <summary>
    /// Returns the earliest difference between the timelines of the two worlds, with both versions of it; null if there is none. History
    /// that either world has forgotten is not compared. Where no path differs, crossings of sensors are compared.
    /// </summary>
    internal static string? FirstDifference(Engine expected, Engine actual)
    {
        SimTime edge = SimTime.Max(expected.Progress.HistoryEdge, actual.Progress.HistoryEdge);
        EventKey least = default;
        string? difference = null;
        for (int n = 0; n < Math.Max(expected.Bodies.Count, actual.Bodies.Count); n++)
        {
            BodyTable known = n < expected.Bodies.Count ? expected.Bodies : actual.Bodies;
            BodyId body = known.Id(known.SlotAt(n));
            int a = FirstSince(expected, body, edge);
            int b = FirstSince(actual, body, edge);
            while ((a != TimelineStore.None || b != TimelineStore.None) && IsSame(expected.Timelines, a, actual.Timelines, b))
            {
                a = expected.Timelines.Next(a);
                b = actual.Timelines.Next(b);
            }

            if (a == TimelineStore.None && b == TimelineStore.None)
            {
                continue;
            }

            EventKey key = a == TimelineStore.None || (b != TimelineStore.None && EventKey.Compare(actual.Timelines.Key(b), expected.Timelines.Key(a)) < 0)
                ? actual.Timelines.Key(b)
                : expected.Timelines.Key(a);
            if (difference is null || EventKey.Compare(key, least) < 0)
            {
                least = key;
                difference = $"Body {body}: expected {Describe(expected.Timelines, a)}, got {Describe(actual.Timelines, b)}.";
            }
        }

        return difference ?? FirstDifferentCrossing(expected, actual, edge);
    }

    private static string? FirstDifferentCrossing(Engine expected, Engine actual, SimTime edge)
    {
        SimTime to = SimTime.Min(expected.Progress.SimulatedTo, actual.Progress.SimulatedTo);
        IReadOnlyList<Crossing> a = expected.Reader.CrossingsIn(edge, to);
        IReadOnlyList<Crossing> b = actual.Reader.CrossingsIn(edge, to);
        int n = 0;
        while (n < a.Count && n < b.Count && a[n] == b[n])
        {
            n++;
        }

        return n == a.Count && n == b.Count
            ? null
            : $"Crossings: expected {(n < a.Count ? a[n].ToString() : "no more")}, got {(n < b.Count ? b[n].ToString() : "no more")}.";
    }

    private static int FirstSince(Engine engine, BodyId body, SimTime edge)
    {
        int slot = engine.Bodies.SlotOf(body);
        int at = slot < 0 ? TimelineStore.None : engine.Timelines.Last(slot);
        int since = TimelineStore.None;
        while (at != TimelineStore.None && engine.Timelines.Key(at).Time >= edge && engine.Timelines.Key(at).Kind != EventKind.None)
        {
            since = at;
            at = engine.Timelines.Previous(at);
        }

        return since;
    }

    private static bool IsSame(TimelineStore expected, int a, TimelineStore actual, int b)
    {
        if (a == TimelineStore.None || b == TimelineStore.None || expected.Key(a) != actual.Key(b))
        {
            return false;
        }

        ref readonly MotionSegment x = ref expected.Segment(a);
        ref readonly MotionSegment y = ref actual.Segment(b);
        return x.IsSameAs(y) && expected.HoldOf(a) == actual.HoldOf(b) && expected.SpinOf(a).IsSameAs(actual.SpinOf(b))
            && expected.Extras.Filter(a) == actual.Extras.Filter(b) && (!x.IsDense || expected.Dense(a).IsSameAs(actual.Dense(b)));
    }

    private static string Describe(TimelineStore timelines, int segment)
    {
        if (segment == TimelineStore.None)
        {
            return "nothing more";
        }

        ref readonly MotionSegment path = ref timelines.Segment(segment);
        return string.Format(
            CultureInfo.InvariantCulture, "{0} ({1} from {2} m with {3} m/s at {4} to {5})", timelines.Key(segment), path.Law, path.Position, path.Velocity, path.Epoch, path.End);
    }
}
