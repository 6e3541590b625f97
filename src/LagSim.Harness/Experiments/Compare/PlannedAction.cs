using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>One planned action of a player.</summary>
/// <param name="Time">The time of the action, after the start of the scene by the host's shared clock.</param>
/// <param name="Peer">The player's number in the session.</param>
/// <param name="Kind">The kind: an impulse, a velocity, a teleport or a spawn.</param>
/// <param name="Body">The body it acts on; for a spawn the new body.</param>
/// <param name="Position">The position, in metres, for a teleport or a spawn.</param>
/// <param name="Velocity">The new velocity, in m/s; for an impulse the impulse, in newton seconds.</param>
/// <param name="Spec">The spec of the spawned body.</param>
public sealed record PlannedAction(SimDuration Time, int Peer, EventKind Kind, BodyId Body, Vector3D Position, Vector3D Velocity, BodySpec Spec)
{
    /// <summary>Converts it to a player's action.</summary>
    public PlayerAction ToAction() => Kind switch
    {
        EventKind.Impulse => PlayerAction.Impulse(Body, Velocity),
        EventKind.SetVelocity => PlayerAction.SetVelocity(Body, Velocity),
        EventKind.Teleport => PlayerAction.Teleport(Body, Position, Velocity),
        EventKind.Spawn => PlayerAction.Spawn(Spec, Position, Velocity),
        _ => throw new InvalidOperationException($"A plan has no {Kind}."),
    };
}
