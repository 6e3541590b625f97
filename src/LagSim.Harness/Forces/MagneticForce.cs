using LagSim.Scenes;

namespace LagSim.Harness.Forces;

/// <summary>A force across the velocity, magnetic or Magnus: a = v x omega.</summary>
/// <param name="omega">The angular velocity at which the velocity turns, per second: charge over mass times field.</param>
internal sealed class MagneticForce(Vector3D omega) : IAcceleration
{
    public string Name => "magnetic";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => Vector3D.Cross(velocity, omega);
}
