using LagSim.Scenes;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A force of the library on 1 kg as a program would supply it: the engine knows its name and version, and nothing of what it is.
/// </summary>
internal sealed class SuppliedForce(Force force) : IAcceleration
{
    public string Name => force.Name;

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => force.At(1, seconds, position, velocity, Vector3D.Zero);
}
