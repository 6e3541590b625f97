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
    /// <param name="external">The event.</param>
    /// <param name="place">Where a teleport puts the body.</param>
    /// <param name="before">The segment.</param>
    /// <param name="dense">Its integrated path.</param>
    /// <param name="seconds">How far into it the event comes.</param>
    /// <param name="mass">The body's mass, in kg.</param>
    /// <param name="scene">The scene.</param>
    /// <param name="position">Where the body is then, in metres.</param>
    /// <param name="velocity">Its velocity then, in m/s.</param>
    internal static bool TryApply(
        in ExternalEvent external, in Vector3D place, in MotionSegment before, in DenseOutput dense, double seconds, double mass, Scene scene,
        out Vector3D position, out Vector3D velocity)
    {
        position = external.Kind == EventKind.Teleport ? place : before.PositionAt(seconds, dense);
        velocity = external.Kind switch
        {
            EventKind.Teleport or EventKind.SetVelocity => external.Velocity,
            EventKind.Impulse => before.VelocityAt(seconds, dense) + (external.Velocity / mass),
            _ => throw new InvalidOperationException($"{external.Kind} has no effect of its own on a state."),
        };
        return velocity.Length <= Limits.MaxGivenSpeed(scene.SmallestRadius);
    }
}
