using LagSim.Scenes;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// A spring to the vertical axis, a drag, and a push that grows with time: an acceleration that varies everywhere and always.
/// </summary>
internal sealed class CentralPull : IAcceleration
{
    public string Name => "lagsim check pull";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) =>
        (velocity * -0.2) + new Vector3D(-2 * position.X, (0.05 * seconds) - 4, -2 * position.Z);
}
