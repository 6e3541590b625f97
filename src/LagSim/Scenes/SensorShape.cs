namespace LagSim.Scenes;

/// <summary>The shape of a <see cref="Sensor"/>. The number is part of wire and hashes.</summary>
public enum SensorShape : byte
{
    /// <summary>The half-space behind a plane.</summary>
    Plane = 0,

    /// <summary>A ball: what is within a radius of a centre.</summary>
    Sphere = 1,
}
