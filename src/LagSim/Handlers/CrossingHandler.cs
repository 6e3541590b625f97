using LagSim.Contacts;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Handlers;

/// <summary>Handles crossings: a body enters or leaves a sensor. No path changes, and no segment is opened.</summary>
internal sealed class CrossingHandler(
    Scene scene, BodyTable bodies, TimelineStore timelines, CrossingLog log, ContactGraph graph, RewindRequests rewinds)
{
    /// <summary>
    /// Records the crossing; the graph then has its body, and the carrier of the sensor, whose next events are to be predicted. False if
    /// the body is ahead of the crossing, which its carrier found, and has to be rewound first.
    /// </summary>
    internal bool TryHandle(in EventKey key)
    {
        int body = bodies.SlotOf(key.Body);
        int newest = log.Last(body);
        if (EventKey.Compare(timelines.Key(timelines.Last(body)), key) > 0
            || (newest != CrossingLog.None && EventKey.Compare(log.Key(newest), key) > 0))
        {
            rewinds.Add(body, key);
            return false;
        }

        log.Add(body, key);
        graph.Clear();
        graph.AddBody(body);
        if (scene.SensorArray[(int)key.Sequence].Carrier is BodyId carrier && bodies.SlotOf(carrier) is int other && other >= 0)
        {
            graph.AddBody(other); // both may have found it
        }

        return true;
    }
}
