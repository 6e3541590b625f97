using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Check;

/// <summary>One drawn action of a player.</summary>
/// <param name="AtSeconds">The time, from the session's start. Two actions of one peer at the same time get the same stamp. A second one of
/// another peer waits until that peer's clock reads the first one's stamp to the tick, if it is not past it already.</param>
/// <param name="Peer">The player, by index. If it is not in the session at the time, the host acts instead.</param>
/// <param name="Kind">The kind of action.</param>
/// <param name="Body">The body of the scene, by its index when drawn; negative for a spawned one.</param>
/// <param name="Spawn">The index of the action that spawned the body; negative for a body of the scene.</param>
/// <param name="Position">The new position, in metres; for a grab the grab point from the body's centre, for a keyframe the hand's
/// position.</param>
/// <param name="Velocity">The new velocity, in m/s; for an impulse the change of velocity, for a keyframe the hand's velocity.</param>
/// <param name="Spec">For a spawn the spec of the new body; for an impulse that of the body it acts on.</param>
/// <param name="Spin">The spin of a spawn, in rad/s.</param>
/// <param name="Filter">The new filter of the body.</param>
/// <param name="Command">What the rules are told.</param>
/// <param name="Players">Who may touch a spawned body.</param>
/// <param name="WhenOccupied">What becomes of a spawn or a teleport where another body is.</param>
internal sealed record CheckAction(
    double AtSeconds, int Peer, EventKind Kind, int Body, int Spawn, Vector3D Position, Vector3D Velocity, BodySpec Spec, Vector3D Spin = default,
    CollisionFilter Filter = default, PeerSet Players = default, WhenOccupied WhenOccupied = default, GameCommand? Command = null)
{
    internal PlayerAction On(BodyId body) => Kind switch
    {
        EventKind.Spawn => PlayerAction.Spawn(Spec, Position, Velocity, Spin, Players, WhenOccupied),
        EventKind.Remove => PlayerAction.Remove(body),
        EventKind.Teleport => PlayerAction.Teleport(body, Position, Velocity, WhenOccupied),
        EventKind.SetVelocity => PlayerAction.SetVelocity(body, Velocity),
        EventKind.Grab => PlayerAction.Grab(body, Position),
        EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(body, Position, Velocity),
        EventKind.Release => PlayerAction.Release(body, Velocity),
        EventKind.Command => PlayerAction.Command(Command!),
        EventKind.SetFilter => PlayerAction.SetFilter(body, Filter),
        _ => PlayerAction.Impulse(body, Velocity * Spec.Mass),
    };
}
