using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Harness.Verification.Harm;

/// <summary>One thing that a player does.</summary>
/// <param name="AtSeconds">When, from the beginning of the attack on.</param>
/// <param name="Kind">What.</param>
/// <param name="Spawn">Of one of its own bodies which, by the order of the spawns, from 0; -1 for one of the scene's.</param>
/// <param name="Body">Of a body of the scene which; of a spawn the one it takes after.</param>
/// <param name="Place">Where, or how far from the centre.</param>
/// <param name="Velocity">How fast.</param>
internal sealed record HarmAction(double AtSeconds, EventKind Kind, int Spawn, int Body, Vector3D Place, Vector3D Velocity = default)
{
    /// <summary>It as an action.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="spawned">What the player's spawns so far became.</param>
    internal PlayerAction In(Scene scene, Func<int, BodyId> spawned)
    {
        BodyId body = Spawn >= 0 && Kind != EventKind.Spawn ? spawned(Spawn) : BodyId.OfScene(Body);
        return Kind switch
        {
            EventKind.Spawn => PlayerAction.Spawn(scene.Bodies[Body].Spec, Place, Velocity),
            EventKind.SetVelocity => PlayerAction.SetVelocity(body, Velocity),
            EventKind.Teleport => PlayerAction.Teleport(body, Place, Velocity),
            EventKind.Grab => PlayerAction.Grab(body, default),
            EventKind.HoldKeyframe => PlayerAction.HoldKeyframe(body, Place, Velocity),
            _ => PlayerAction.Remove(body),
        };
    }

    /// <summary>It as the tool's <c>--do</c> takes it, as far as that can be said: all that begins at rest.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="from">The seconds that the attack begins at.</param>
    /// <param name="player">The player's number.</param>
    /// <param name="sequences">The number of the event that each spawn is.</param>
    internal string ToText(Scene scene, double from, int player, Func<int, uint> sequences)
    {
        string body = Spawn >= 0 && Kind != EventKind.Spawn ? string.Create(CultureInfo.InvariantCulture, $"{player}.{sequences(Spawn)}.0") : scene.Bodies[Body].Name;
        (string kind, Vector3D vector) = Kind switch
        {
            EventKind.Spawn => ("spawn", Place),
            EventKind.SetVelocity => ("set-velocity", Velocity),
            EventKind.Teleport => ("teleport", Place),
            EventKind.Grab => ("grab", default),
            EventKind.HoldKeyframe => ("knot", Place),
            _ => ("remove", default),
        };
        string where = kind == "remove" ? "" : string.Create(CultureInfo.InvariantCulture, $":{vector.X:R},{vector.Y:R},{vector.Z:R}");
        return string.Create(CultureInfo.InvariantCulture, $"{kind}@{from + AtSeconds:0.####}:{body}{where}");
    }
}
