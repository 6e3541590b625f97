using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Checks the sensors of a scene.</summary>
internal static class SensorCheck
{
    /// <summary>Checks them all.</summary>
    /// <param name="scene">The name of the scene.</param>
    /// <param name="sensors">Its sensors.</param>
    /// <param name="box">Its periodic box, if it has one.</param>
    /// <exception cref="SceneException">Something is not valid; the sentence names the value and what is allowed.</exception>
    internal static void Throw(string scene, List<Sensor> sensors, PeriodicBox box)
    {
        if (sensors.Count > SceneBuilder.MaxSensors)
        {
            throw new SceneException($"Scene '{scene}' has {sensors.Count} sensors; at most {SceneBuilder.MaxSensors} are allowed.");
        }

        if (box.Exists && sensors.Count > 0)
        {
            throw new SceneException($"Scene '{scene}' has a periodic box and {Limits.Count(sensors.Count, "sensor")}; a periodic box goes with none.");
        }

        foreach (Sensor sensor in sensors)
        {
            string whose = $"sensor '{sensor.Name}'";
            if (sensor.Coverage > SensorCoverage.Whole)
            {
                throw new SceneException($"The coverage of {whose} is {(byte)sensor.Coverage}; it is 0 to {(byte)SensorCoverage.Whole}.");
            }

            if (sensor.Shape == SensorShape.Plane)
            {
                Limits.InRange(sensor.Offset, -Limits.MaxCoordinate, Limits.MaxCoordinate, whose, "offset", "m");
                continue;
            }

            Limits.CheckPosition(sensor.Centre, whose);
            Limits.InRange(sensor.Radius, Limits.MinRadius, Limits.MaxRadius, whose, "radius", "m");
        }
    }
}
