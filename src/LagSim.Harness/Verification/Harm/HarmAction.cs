using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Harm;

/// <summary>One action of an attacker.</summary>
/// <param name="AtSeconds">The time, in seconds from the beginning of the attack.</param>
/// <param name="Kind">The kind of action.</param>
/// <param name="Spawn">The index of one of the attacker's spawns, in order, from 0; -1 for a body of the scene.</param>
/// <param name="Body">The body of the scene; for a spawn the one it copies.</param>
/// <param name="Place">The position, or the offset from the centre, in metres.</param>
/// <param name="Velocity">The velocity, in m/s.</param>
internal sealed record HarmAction(double AtSeconds, EventKind Kind, int Spawn, int Body, Vector3D Place, Vector3D Velocity = default)
{
    /// <summary>For a spawn that copies no body of the scene, what it is.</summary>
    internal BodySpec? Spec { get; init; }

    /// <summary>Converts it to a player's action.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="spawned">The bodies that the player has spawned so far.</param>
    internal PlayerAction In(Scene scene, Func<int, BodyId> spawned)
    {
        BodyId body = Spawn >= 0 && Kind != EventKind.Spawn ? spawned(Spawn) : BodyId.OfScene(Body);
        return Kind switch
        {
            EventKind.Spawn => PlayerAction.Spawn(Spec ?? scene.Bodies[Body].Spec, Place, Velocity),
            EventKind.SetVelocity => PlayerAction.SetVelocity(body, Velocity),
            EventKind.Teleport => PlayerAction.Teleport(body, Place, Velocity),
            EventKind.Grab => PlayerAction.Grab(body, default),
            EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(body, Place, Velocity),
            EventKind.SetFilter => PlayerAction.SetFilter(body, CollisionFilter.None),
            _ => PlayerAction.Remove(body),
        };
    }

    /// <summary>Formats it for the tool's <c>--do</c>, as far as that can express it: bodies that begin at rest.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="from">The start of the attack, in seconds.</param>
    /// <param name="player">The player's number.</param>
    /// <param name="sequences">The event number of each spawn.</param>
    internal string ToText(Scene scene, double from, int player, Func<int, uint> sequences)
    {
        string body = Spawn >= 0 && Kind != EventKind.Spawn ? string.Create(CultureInfo.InvariantCulture, $"{player}.{sequences(Spawn)}.0") : scene.Bodies[Body].Name;
        (string kind, Vector3D vector) = Kind switch
        {
            EventKind.Spawn => ("spawn", Place),
            EventKind.SetVelocity => ("set-velocity", Velocity),
            EventKind.Teleport => ("teleport", Place),
            EventKind.Grab => ("grab", default),
            EventKind.HoldKeyframe => ("keyframe", Place),
            _ => ("remove", default),
        };
        string where = kind == "remove" ? "" : string.Create(CultureInfo.InvariantCulture, $":{vector.X:R},{vector.Y:R},{vector.Z:R}");
        return string.Create(CultureInfo.InvariantCulture, $"{kind}@{from + AtSeconds:0.####}:{body}{where}");
    }
}
