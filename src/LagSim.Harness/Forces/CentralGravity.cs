using LagSim.Scenes;

namespace LagSim.Harness.Forces;

/// <summary>The pull of a mass at the origin: a = -mu x / |x|^3.</summary>
/// <param name="mu">Its standard gravitational parameter, m^3/s^2.</param>
internal sealed class CentralGravity(double mu) : IAcceleration
{
    public string Name => "central gravity";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity)
    {
        double square = position.LengthSquared;
        return position * (-mu / (square * position.Length));
    }
}
