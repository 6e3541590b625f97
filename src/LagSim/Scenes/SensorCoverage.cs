namespace LagSim.Scenes;

/// <summary>How much of a body has to be in the region of a <see cref="Sensor"/>. The number is part of wire and hashes.</summary>
public enum SensorCoverage : byte
{
    /// <summary>Its centre.</summary>
    Centre = 0,

    /// <summary>Any part of it: the region counts as grown by the body's radius.</summary>
    Part = 1,

    /// <summary>All of it: the region counts as shrunk by the body's radius. What does not fit in is never inside.</summary>
    Whole = 2,
}
