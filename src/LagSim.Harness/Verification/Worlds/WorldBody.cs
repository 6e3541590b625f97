using LagSim.Scenes;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>A body at an instant.</summary>
internal sealed record WorldBody(BodyId Id, BodySpec Spec, BodyState State)
{
    internal double Speed => State.Velocity.Length;
}
