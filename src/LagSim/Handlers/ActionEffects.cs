using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;

namespace LagSim.Handlers;

/// <summary>Applies impulses, new velocities and teleports to a state.</summary>
internal static class ActionEffects
{
    /// <summary>
    /// The state right after an event that comes so many seconds into a segment. False if it would be faster than may be given: the check
    /// at submission cannot know the velocity that an impulse meets, so such an event has no effect, on every peer alike.
    /// </summary>
    internal static bool TryApply(
        in ExternalEvent external, in MotionSegment before, in DenseOutput dense, double seconds, double mass, Scene scene,
        out Vector3D position, out Vector3D velocity)
    {
        position = external.Kind == EventKind.Teleport ? external.Position : before.PositionAt(seconds, dense);
        velocity = external.Kind switch
        {
            EventKind.Teleport or EventKind.SetVelocity => external.Velocity,
            EventKind.Impulse => before.VelocityAt(seconds, dense) + (external.Velocity / mass),
            _ => throw new InvalidOperationException($"{external.Kind} has no effect of its own on a state."),
        };
        return velocity.Length <= Limits.MaxGivenSpeed(scene.SmallestRadius);
    }
}
