using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>Random sensors of a session's scene: planes and spheres where its bodies are.</summary>
internal sealed class CheckSensors
{
    private const int Most = 6;
    private const ulong LaterStream = 1; // what is drawn of sensors besides their places, so that all else stays the same

    private readonly Sensor[] sensors;
    private readonly int[] carriers; // by sensor: the number of the body that carries it, -1 for none
    private readonly CollisionFilter[] filters; // by sensor
    private readonly double[] offsets; // by sensor: what part of its place it is off its carrier

    /// <param name="random">The stream to draw from.</param>
    /// <param name="bodies">How many bodies the scene has.</param>
    internal CheckSensors(SeededRandom random, int bodies)
    {
        SceneBuilder drawn = new("sensors");
        int count = 1 + random.NextInt(Most);
        for (int i = 0; i < count; i++)
        {
            SensorCoverage coverage = random.Pick(SensorCoverage.Centre, SensorCoverage.Part, SensorCoverage.Whole);
            Vector3D place = new(random.NextDouble(-2, 2), random.NextDouble(0, 4), random.NextDouble(-1, 1));
            if (random.IsLucky(50))
            {
                Vector3D leaning = new(random.NextDouble(-1, 1), random.NextDouble(-1, 1), random.NextDouble(-1, 1));
                Vector3D normal = random.Pick(Vector3D.Up, new Vector3D(1, 0, 0), leaning);
                drawn.AddSensorPlane($"sensor {i}", normal, place, coverage);
            }
            else
            {
                drawn.AddSensorSphere($"sensor {i}", place, random.NextDouble(0.3, 2), coverage);
            }
        }

        sensors = [.. drawn.Build().Sensors];
        SeededRandom later = random.Fork(LaterStream);
        carriers = Array.ConvertAll(
            sensors, sensor => sensor.Shape == SensorShape.Sphere && later.IsLucky(50) ? later.NextInt(bodies) : -1);
        CollisionFilter[] some = [new CollisionFilter(2), new CollisionFilter(1, 1), new CollisionFilter(2, 1), new CollisionFilter(3, 2)];
        filters = Array.ConvertAll(sensors, _ => later.IsLucky(25) ? later.Pick(some) : default);
        offsets = Array.ConvertAll(sensors, _ => later.IsLucky(50) ? 0 : later.NextDouble() * 0.5);
    }

    /// <summary>Adds the sensors to a scene; those whose carrier is not in it stand still.</summary>
    /// <param name="builder">The scene.</param>
    /// <param name="kept">The numbers that its bodies had when drawn.</param>
    /// <param name="nameOf">The name of the body of a number.</param>
    internal void AddTo(SceneBuilder builder, IReadOnlyList<int> kept, Func<int, string> nameOf)
    {
        for (int i = 0; i < sensors.Length; i++)
        {
            Sensor sensor = sensors[i];
            bool isCarried = kept.Contains(carriers[i]);
            _ = sensor.Shape == SensorShape.Plane
                ? builder.AddSensorPlane(sensor.Name, sensor.Normal, sensor.Offset, sensor.Coverage, filters[i])
                : builder.AddSensorSphere(
                    sensor.Name, isCarried ? sensor.Centre * offsets[i] : sensor.Centre, sensor.Radius, sensor.Coverage, filters[i],
                    isCarried ? nameOf(carriers[i]) : null);
        }
    }
}
