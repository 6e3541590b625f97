using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>The sync test: a second world, in which every late event rolls everything back, is held against the healed one.</content>
public sealed partial class Simulation
{
    private Simulation? twin;
    private bool isTwinDue;

    /// <summary>Brings the twin to where this world is and, if something was healed, compares the two.</summary>
    /// <exception cref="SimulationException">They differ.</exception>
    private void FollowWithTwin()
    {
        if (twin is null)
        {
            return;
        }

        if (twin.SimulatedTo < SimulatedTo)
        {
            twin.AdvanceTo(SimulatedTo);
        }

        if (isTwinDue && !rollback.IsActive && twin.SimulatedTo == SimulatedTo)
        {
            isTwinDue = false;
            if (FirstDifference(twin, this) is string difference)
            {
                fault = new SimulationException($"The sync test failed: the world as healed and the world as fully rolled back differ. {difference}");
                throw fault;
            }
        }
    }

    /// <summary>
    /// The first thing in the timelines of one world that is not in the other's to the bit, with both versions of it; null if there is none. What either has
    /// forgotten is not compared.
    /// </summary>
    internal static string? FirstDifference(Simulation expected, Simulation actual)
    {
        SimTime edge = SimTime.Max(expected.HistoryEdge, actual.HistoryEdge);
        EventKey least = default;
        string? difference = null;
        for (int n = 0; n < Math.Max(expected.bodies.Count, actual.bodies.Count); n++)
        {
            Scenes.BodyId body = n < expected.bodies.Count ? expected.BodyAt(n) : actual.BodyAt(n);
            int a = FirstSince(expected, body, edge);
            int b = FirstSince(actual, body, edge);
            while ((a != TimelineStore.None || b != TimelineStore.None) && IsSame(expected, a, actual, b))
            {
                a = expected.timelines.Next(a);
                b = actual.timelines.Next(b);
            }

            if (a == TimelineStore.None && b == TimelineStore.None)
            {
                continue;
            }

            EventKey key = a == TimelineStore.None || (b != TimelineStore.None && EventKey.Compare(actual.timelines.Key(b), expected.timelines.Key(a)) < 0)
                ? actual.timelines.Key(b)
                : expected.timelines.Key(a);
            if (difference is null || EventKey.Compare(key, least) < 0)
            {
                least = key;
                difference = $"Body {body}: expected {Describe(expected, a)}, got {Describe(actual, b)}.";
            }
        }

        return difference;
    }

    private static int FirstSince(Simulation simulation, Scenes.BodyId body, SimTime edge)
    {
        int slot = simulation.bodies.SlotOf(body);
        int at = slot < 0 ? TimelineStore.None : simulation.timelines.Last(slot);
        int since = TimelineStore.None;
        while (at != TimelineStore.None && simulation.timelines.Key(at).Time >= edge && simulation.timelines.Key(at).Kind != EventKind.None)
        {
            since = at;
            at = simulation.timelines.Previous(at);
        }

        return since;
    }

    private static bool IsSame(Simulation expected, int a, Simulation actual, int b)
    {
        if (a == TimelineStore.None || b == TimelineStore.None || expected.timelines.Key(a) != actual.timelines.Key(b))
        {
            return false;
        }

        ref readonly MotionSegment x = ref expected.timelines.Segment(a);
        ref readonly MotionSegment y = ref actual.timelines.Segment(b);
        return x.IsSameAs(y) && expected.timelines.HoldOf(a) == actual.timelines.HoldOf(b) && expected.timelines.SpinOf(a).IsSameAs(actual.timelines.SpinOf(b))
            && (!x.IsDense || expected.timelines.Dense(a).IsSameAs(actual.timelines.Dense(b)));
    }

    private static string Describe(Simulation simulation, int segment)
    {
        if (segment == TimelineStore.None)
        {
            return "nothing more";
        }

        ref readonly MotionSegment path = ref simulation.timelines.Segment(segment);
        return string.Format(
            CultureInfo.InvariantCulture, "{0} ({1} from {2} m with {3} m/s at {4} to {5})", simulation.timelines.Key(segment), path.Law, path.Position, path.Velocity, path.Epoch, path.End);
    }
}
