using LagSim.Scenes;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A force of the library on 1 kg, supplied as a user-defined force: the engine knows only its name and version.
/// </summary>
internal sealed class SuppliedForce(Force force) : IAcceleration
{
    public string Name => force.Name;

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => force.At(1, seconds, position, velocity, Vector3D.Zero);
}
