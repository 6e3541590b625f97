using LagSim.Scenes;

namespace LagSim.Harness.Forces;

/// <summary>A spring to a point, with damping if wanted: a = -omega^2 (x - anchor) - c v.</summary>
/// <param name="omega">The angular frequency without damping, per second.</param>
/// <param name="damping">c, per second.</param>
/// <param name="anchor">Where it pulls to, in metres.</param>
internal sealed class LinearSpring(double omega, double damping = 0, Vector3D anchor = default) : IAcceleration
{
    public string Name => "spring";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => ((position - anchor) * (-omega * omega)) - (velocity * damping);
}
