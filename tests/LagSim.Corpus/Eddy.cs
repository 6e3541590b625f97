using LagSim.Scenes;

namespace LagSim.Corpus;

/// <summary>Wind that turns about the y axis and swells with time: an acceleration that depends on all three of time, place and velocity.</summary>
public sealed class Eddy : IAcceleration
{
    private const double PerSecond = 0.8;

    public string Name => "corpus eddy";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity)
    {
        double strength = seconds / (1 + position.LengthSquared);
        Vector3D wind = new(-position.Z * strength, 0, position.X * strength);
        return (wind - velocity) * PerSecond;
    }
}
