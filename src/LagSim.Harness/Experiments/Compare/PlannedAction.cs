using System;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>What a player will do, and when.</summary>
/// <param name="Time">After the start of the scene, by the host's shared clock.</param>
/// <param name="Peer">Who, by the number that he has in the session.</param>
/// <param name="Kind">What: an impulse, a velocity, a teleport or a spawn.</param>
/// <param name="Body">To which body; of a spawn the new one.</param>
/// <param name="Position">Where it is put, in metres, by a teleport or a spawn.</param>
/// <param name="Velocity">The velocity in m/s that it gets; of an impulse its newton seconds.</param>
/// <param name="Spec">What is spawned.</param>
public sealed record PlannedAction(SimDuration Time, int Peer, EventKind Kind, BodyId Body, Vector3D Position, Vector3D Velocity, BodySpec Spec)
{
    /// <summary>The same as an action of a player.</summary>
    public PlayerAction ToAction() => Kind switch
    {
        EventKind.Impulse => PlayerAction.Impulse(Body, Velocity),
        EventKind.SetVelocity => PlayerAction.SetVelocity(Body, Velocity),
        EventKind.Teleport => PlayerAction.Teleport(Body, Position, Velocity),
        EventKind.Spawn => PlayerAction.Spawn(Spec, Position, Velocity),
        _ => throw new InvalidOperationException($"A plan has no {Kind}."),
    };
}
