using LagSim.Contacts;
using LagSim.Events;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Handles crossings: a body enters or leaves a sensor. No path changes, and no segment is opened.</summary>
internal sealed class CrossingHandler(CrossingLog log, ContactGraph graph)
{
    /// <summary>Records the crossing; the graph then has its body, whose next event is to be predicted.</summary>
    internal bool Handle(int slot, in EventKey key)
    {
        log.Add(slot, key);
        graph.Clear();
        graph.AddBody(slot);
        return true;
    }
}
