using System;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>A drawn scene, and what players may do in it.</summary>
internal sealed record WorldScene
{
    internal required WorldKind Kind { get; init; }

    internal required Scene Scene { get; init; }

    /// <summary>How long the world runs, in seconds.</summary>
    internal double Seconds { get; init; } = 2;

    /// <summary>Draws what a player spawns.</summary>
    internal required Func<SeededRandom, BodySpec> DrawSpec { get; init; }

    /// <summary>Draws where a player puts something.</summary>
    internal required Func<SeededRandom, Vector3D> DrawPlace { get; init; }

    /// <summary>The slowest and the fastest that players throw, in m/s.</summary>
    internal (double Slow, double Fast) Throw { get; init; } = (0.05, 6);

    /// <summary>The speed that the scene's forces give from rest within the run, in m/s, its gravity not among them.</summary>
    internal double FieldSpeed { get; init; }

    /// <summary>Whether players take bodies with their hands.</summary>
    internal bool HasHands { get; init; }

    /// <summary>Whether players change filters.</summary>
    internal bool HasFilters { get; init; }

    /// <summary>Draws a velocity in any direction, of a size between the slowest and the fastest.</summary>
    internal Vector3D DrawVelocity(SeededRandom from) => WorldDraws.Direction(from) * WorldDraws.LogUniform(from, Throw.Slow, Throw.Fast);
}
