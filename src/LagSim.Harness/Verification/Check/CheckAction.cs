using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Check;

/// <summary>Something that a player is to do, at some time.</summary>
/// <param name="AtSeconds">When, from the session's start on. Two of one peer with the same time get the same stamp; the second, by
/// another peer, waits until that one's clock reads the first one's stamp to the tick, if it is not past it already.
/// </param>
/// <param name="Peer">Who, by index; if that one is not in the session at the time, the host does it.</param>
/// <param name="Kind">What.</param>
/// <param name="Body">To which body of the scene, by the index it was drawn with; negative where to a spawned one.</param>
/// <param name="Spawn">To the body that an action spawned, by the index of that action; negative where to one of the scene's.</param>
/// <param name="Position">Where to, in metres; of a grab by which point from the body's centre, of a keyframe where the hand is.</param>
/// <param name="Velocity">Metres per second, of an impulse the change of velocity, of a keyframe the hand's.</param>
/// <param name="Spec">Of a spawn what appears; of an impulse what it is done to.</param>
/// <param name="Spin">Radians per second, of a spawn.</param>
internal sealed record CheckAction(
    double AtSeconds, int Peer, EventKind Kind, int Body, int Spawn, Vector3D Position, Vector3D Velocity, BodySpec Spec, Vector3D Spin = default)
{
    internal PlayerAction On(BodyId body) => Kind switch
    {
        EventKind.Spawn => PlayerAction.Spawn(Spec, Position, Velocity, Spin),
        EventKind.Remove => PlayerAction.Remove(body),
        EventKind.Teleport => PlayerAction.Teleport(body, Position, Velocity),
        EventKind.SetVelocity => PlayerAction.SetVelocity(body, Velocity),
        EventKind.Grab => PlayerAction.Grab(body, Position),
        EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(body, Position, Velocity),
        EventKind.Release => PlayerAction.Release(body, Velocity),
        _ => PlayerAction.Impulse(body, Velocity * Spec.Mass),
    };
}
