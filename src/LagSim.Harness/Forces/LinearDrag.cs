using LagSim.Scenes;

namespace LagSim.Harness.Forces;

/// <summary>Drag in proportion to the speed: a = -k v.</summary>
/// <param name="k">Per second.</param>
internal sealed class LinearDrag(double k) : IAcceleration
{
    public string Name => "linear drag";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => velocity * -k;
}
