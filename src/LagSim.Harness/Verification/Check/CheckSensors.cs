using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>Random sensors of a session's scene: planes and spheres where its bodies are.</summary>
internal sealed class CheckSensors
{
    private const int Most = 6;

    private readonly Sensor[] sensors;

    internal CheckSensors(SeededRandom random)
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
    }

    internal void AddTo(SceneBuilder builder)
    {
        foreach (Sensor sensor in sensors)
        {
            _ = sensor.Shape == SensorShape.Plane
                ? builder.AddSensorPlane(sensor.Name, sensor.Normal, sensor.Offset, sensor.Coverage)
                : builder.AddSensorSphere(sensor.Name, sensor.Centre, sensor.Radius, sensor.Coverage);
        }
    }
}
