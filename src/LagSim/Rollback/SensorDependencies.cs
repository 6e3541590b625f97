using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// Which crossings depend on a body's path: its own, and those of sensors that it carries by others. Where the carrier's path is cut or
/// ends, the bodies that cross the sensor later are to be rewound to where they first do.
/// </summary>
internal sealed class SensorDependencies(Scene scene, BodyTable bodies, CrossingLog log)
{
    private readonly BodyId?[] carriers = Array.ConvertAll(scene.SensorArray, sensor => sensor.Carrier);
    private readonly Stack<(int Slot, EventKey Key)> dependents = new();

    /// <summary>All crossings.</summary>
    internal CrossingLog Log { get; } = log;

    /// <summary>Whether a body crosses any sensor from a key on.</summary>
    internal bool HasFrom(int slot, in EventKey from) =>
        Log.Last(slot) is int newest && newest != CrossingLog.None && EventKey.Compare(Log.Key(newest), from) >= 0;

    /// <summary>Notes each other body that crosses a sensor of the carrier from a key on, with the key of the first crossing.</summary>
    internal void NoteDependents(int carrier, in EventKey from)
    {
        BodyId id = bodies.Id(carrier);
        if (Array.IndexOf(carriers, id) < 0)
        {
            return;
        }

        foreach (int slot in bodies)
        {
            int first = CrossingLog.None;
            for (int at = Log.Last(slot); at != CrossingLog.None && EventKey.Compare(Log.Key(at), from) >= 0; at = Log.Previous(at))
            {
                first = carriers[Log.At(at).Sensor] == id ? at : first;
            }

            if (first != CrossingLog.None)
            {
                dependents.Push((slot, Log.Key(first)));
            }
        }
    }

    /// <summary>Takes the newest of those that were noted; false if there is none.</summary>
    internal bool TryTakeDependent(out int slot, out EventKey key)
    {
        bool any = dependents.Count > 0;
        (slot, key) = any ? dependents.Pop() : default;
        return any;
    }
}
