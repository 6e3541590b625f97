using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Response;

/// <summary>Opens the segments on which bodies leave an impact.</summary>
internal sealed class ImpactSegments(TimelineStore timelines, ContactGraph graph, TrajectoryFactory trajectories, HandBlows blows)
{
    private readonly Paths paths = new(timelines);
    private readonly PlaneSet touched = new();

    /// <summary>Opens the segment of a body of the graph, from the state in which the graph has it.</summary>
    /// <param name="body">Its number in the graph.</param>
    /// <param name="key">The impact.</param>
    /// <param name="residual">Seconds from the tick to the impact.</param>
    internal void Open(int body, in EventKey key, double residual)
    {
        int slot = graph.Slots[body];
        if (paths.IsHeld(timelines.Last(slot)))
        {
            trajectories.Hands.GoOn(slot, key, blows.GivenBy(body), graph.Velocities[body].Length);
            return;
        }

        SupportSet supports = timelines.Segment(timelines.Last(slot)).Supports;
        touched.Clear();
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref readonly ContactPoint c = ref graph.Contacts[i];
            if (c.First == body && c.IsStruck && graph.IsSupportable(c))
            {
                touched.Add(c.Surface);
            }
        }

        for (int k = 0; k < supports.Count; k++)
        {
            touched.Add(supports[k]);
        }

        trajectories.Open(slot, key, graph.Positions[body], graph.Velocities[body], -residual, touched.Planes, graph.Spins[body]);
    }

    /// <summary>The same of a body in free flight, which nothing carries, and of an impact with no contact but the graph's first.</summary>
    internal void OpenIsolated(int body, in EventKey key, double residual)
    {
        touched.Clear();
        if (graph.IsSupportable(graph.Contacts[0]))
        {
            touched.Add(graph.Contacts[0].Surface);
        }

        trajectories.Open(graph.Slots[body], key, graph.Positions[body], graph.Velocities[body], -residual, touched.Planes, graph.Spins[body]);
    }
}
