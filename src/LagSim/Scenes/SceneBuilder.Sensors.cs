using System.Collections.Generic;

namespace LagSim.Scenes;

public sealed partial class SceneBuilder
{
    /// <summary>The most sensors a scene may have. Each is looked at whenever a body's next event is predicted.</summary>
    public const int MaxSensors = 1024;

    private readonly List<Sensor> sensors = new();

    /// <summary>Adds a sensor behind a plane through a point, such as a goal behind its line. It touches nothing and never moves.</summary>
    /// <param name="sensorName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="normal">Points away from the region; of any length between 1e-150 and 1e150.</param>
    /// <param name="point">Any point of the plane, in metres.</param>
    /// <param name="coverage">How much of a body has to be behind the plane; default its centre.</param>
    /// <exception cref="SceneException">The point is not finite, or the normal has no length.</exception>
    public SceneBuilder AddSensorPlane(string sensorName, Vector3D normal, Vector3D point, SensorCoverage coverage = SensorCoverage.Centre)
    {
        if (!point.IsFinite)
        {
            throw new SceneException($"The point of sensor '{sensorName}' is {point}; every component must be finite.");
        }

        return AddSensorPlane(sensorName, normal, Vector3D.Dot(Unit("sensor", sensorName, normal), point), coverage);
    }

    /// <summary>Adds a sensor of the points p with n . p below <paramref name="offset"/>, n the normal at unit length.</summary>
    /// <param name="sensorName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="normal">Points away from the region; of any length between 1e-150 and 1e150.</param>
    /// <param name="offset">The signed distance of the plane from the origin along the normal, in metres, within 1e12.</param>
    /// <param name="coverage">How much of a body has to be behind the plane; default its centre.</param>
    /// <exception cref="SceneException">The normal is not finite, or has no length.</exception>
    public SceneBuilder AddSensorPlane(string sensorName, Vector3D normal, double offset, SensorCoverage coverage = SensorCoverage.Centre)
    {
        sensors.Add(new Sensor(sensorName, SensorShape.Plane, Unit("sensor", sensorName, normal), offset + 0.0, coverage));
        return this;
    }

    /// <summary>Adds a sensor in a sphere. It touches nothing and never moves.</summary>
    /// <param name="sensorName">1 to 64 characters, no control characters among them, and no other part's.</param>
    /// <param name="centre">In metres, each component within 1e12.</param>
    /// <param name="radius">In metres, 1e-9 to 1e9.</param>
    /// <param name="coverage">How much of a body has to be in the sphere; default its centre.</param>
    public SceneBuilder AddSensorSphere(string sensorName, Vector3D centre, double radius, SensorCoverage coverage = SensorCoverage.Centre)
    {
        sensors.Add(new Sensor(sensorName, SensorShape.Sphere, centre.WithoutNegativeZero(), radius, coverage));
        return this;
    }
}
