using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>Checks the sensors of a scene, and finds the bodies that carry them.</summary>
internal static class SensorCheck
{
    /// <summary>Checks them all.</summary>
    /// <param name="scene">The name of the scene.</param>
    /// <param name="sensors">Its sensors.</param>
    /// <param name="carriers">Of each the name of the body that carries it; null for none.</param>
    /// <param name="bodies">The bodies of the scene.</param>
    /// <returns>The sensors, with their carriers.</returns>
    /// <exception cref="SceneException">Something is not valid; the sentence names the value and what is allowed.</exception>
    internal static Sensor[] Checked(string scene, List<Sensor> sensors, List<string?> carriers, List<SceneBody> bodies)
    {
        if (sensors.Count > SceneBuilder.MaxSensors)
        {
            throw new SceneException($"Scene '{scene}' has {sensors.Count} sensors; at most {SceneBuilder.MaxSensors} are allowed.");
        }

        Sensor[] all = sensors.ToArray();
        for (int i = 0; i < all.Length; i++)
        {
            Check(all[i]);
            if (carriers[i] is string carrier)
            {
                int index = bodies.FindIndex(body => string.Equals(body.Name, carrier, StringComparison.Ordinal));
                all[i] = index >= 0
                    ? all[i].CarriedBy(BodyId.OfScene(index))
                    : throw new SceneException(
                        $"The carrier of sensor '{all[i].Name}' is '{PartName.Shown(carrier)}'; it must be the name of a body of the scene.");
            }
        }

        return all;
    }

    private static void Check(in Sensor sensor)
    {
        string whose = $"sensor '{sensor.Name}'";
        if (sensor.Coverage > SensorCoverage.Whole)
        {
            throw new SceneException($"The coverage of {whose} is {(byte)sensor.Coverage}; it is 0 to {(byte)SensorCoverage.Whole}.");
        }

        if (sensor.Shape == SensorShape.Plane)
        {
            Limits.InRange(sensor.Offset, -Limits.MaxCoordinate, Limits.MaxCoordinate, whose, "offset", "m");
            return;
        }

        Limits.CheckPosition(sensor.Centre, whose);
        Limits.InRange(sensor.Radius, Limits.MinRadius, Limits.MaxRadius, whose, "radius", "m");
    }
}
