using LagSim.Scenes;

namespace LagSim.Harness.Forces;

/// <summary>Drag in proportion to the square of the speed: a = -k |v| v.</summary>
/// <param name="k">Per metre.</param>
internal sealed class QuadraticDrag(double k) : IAcceleration
{
    public string Name => "quadratic drag";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => velocity * (-k * velocity.Length);
}
