using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Scenes;
using LagSim.Timelines;
using LagSim.Trajectories;

namespace LagSim.Handlers;

/// <summary>Handles the end of a segment: an island takes a contact step, and any other body continues by the law that follows.</summary>
internal sealed class StepEndHandler(
    TimelineStore timelines, ContactGraph graph, IslandStepper stepper, TrajectoryFactory trajectories, SegmentLinker linker)
{
    /// <summary>Opens the segments that follow; the graph then has their bodies. False if a body has to be rewound first.</summary>
    internal bool TryHandle(int slot, in EventKey key)
    {
        if (timelines.Segment(timelines.Last(slot)).Law != MotionLaw.Constrained)
        {
            trajectories.OpenNext(slot, key);
            graph.Clear();
            graph.AddBody(slot);
            return true;
        }

        if (!stepper.TryStep(slot, key, out EventKey canonical))
        {
            return false;
        }

        linker.Join(canonical);
        return true;
    }
}
