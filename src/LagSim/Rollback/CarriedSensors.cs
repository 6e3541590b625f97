using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// Which crossings depend on a body's path because it carries the sensor. Where that path is cut or ends, the bodies that cross the sensor
/// later are rewound to where they first do.
/// </summary>
internal sealed class CarriedSensors
{
    private readonly BodyTable bodies;
    private readonly CrossingLog log;
    private readonly BodyId?[] carriers; // by sensor

    private CarriedSensors(BodyTable bodies, CrossingLog log, BodyId?[] carriers)
    {
        this.bodies = bodies;
        this.log = log;
        this.carriers = carriers;
    }

    /// <summary>The carried sensors of a scene; null if it has none.</summary>
    internal static CarriedSensors? Of(Scene scene, BodyTable bodies, CrossingLog log)
    {
        BodyId?[] carriers = Array.ConvertAll(scene.SensorArray, sensor => sensor.Carrier);
        return Array.Exists(carriers, carrier => carrier is not null) ? new CarriedSensors(bodies, log, carriers) : null;
    }

    /// <summary>Adds each other body that crosses a sensor of the carrier from a key on, with the key of the first crossing.</summary>
    internal void AddDependents(int carrier, in EventKey from, List<(int Slot, EventKey Key)> dependents)
    {
        BodyId id = bodies.Id(carrier);
        if (!Carries(id))
        {
            return;
        }

        foreach (int slot in bodies)
        {
            int first = CrossingLog.None;
            for (int at = log.Last(slot); at != CrossingLog.None && EventKey.Compare(log.Key(at), from) >= 0; at = log.Previous(at))
            {
                first = carriers[log.At(at).Sensor] == id ? at : first;
            }

            if (first != CrossingLog.None)
            {
                dependents.Add((slot, log.Key(first)));
            }
        }
    }

    private bool Carries(BodyId id)
    {
        bool carries = false;
        for (int sensor = 0; sensor < carriers.Length && !carries; sensor++)
        {
            carries = carriers[sensor] == id;
        }

        return carries;
    }
}
