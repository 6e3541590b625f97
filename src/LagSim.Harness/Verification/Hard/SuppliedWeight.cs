using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// Weight as a user-defined force. The engine does not know its potential, so any body it presses on another moves in an island's steps and
/// never rests.
/// </summary>
internal sealed class SuppliedWeight : IAcceleration
{
    public string Name => "weight";

    public int Version => 1;

    public Vector3D At(double seconds, in Vector3D position, in Vector3D velocity) => V(0, -Gravity);
}
