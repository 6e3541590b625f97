using System.Collections.Generic;
using AirHockey;
using LagSim.Harness.SceneFiles;
using LagSim.Rules;
using LagSim.Scenes;

namespace LagSim.Play;

/// <summary>Air hockey as a page plays it: the table and the rules of <c>samples/AirHockey</c>, seen from above.</summary>
/// <remarks>What one player does is an <see cref="AirHockeyPlayer"/>, what any peer sees of it an <see cref="AirHockeyBoard"/>.</remarks>
internal static class AirHockeyGame
{
    /// <summary>The scene's name, as a link to the page has it.</summary>
    internal const string Name = "air-hockey";

    /// <summary>How many play at a host of the tool, where nobody sits: it waits for them.</summary>
    internal const int Players = 2;

    /// <summary>Half of what is seen of the table's length, in metres: a goal is behind each end.</summary>
    internal const double HalfViewLength = Table.HalfLength + 0.17;

    /// <summary>Half of what is seen of the table's width, in metres.</summary>
    internal const double HalfViewWidth = Table.HalfWidth + 0.07;

    /// <summary>Returns the table for so many players, 2 to 4; prizes and serves are drawn by the seed.</summary>
    /// <param name="players">How many play, the first of them at the host, unless nobody plays there.</param>
    /// <param name="seed">Of prizes and serves.</param>
    /// <param name="isDedicated">Whether nobody plays at the host.</param>
    internal static Scene Build(int players, ulong seed, bool isDedicated = false) => Table.Build(players, NewRules(), seed, isDedicated);

    /// <summary>All rules that the tool and its page know: those that a scene file can name, and the game's.</summary>
    internal static IReadOnlyList<SceneRules> AllRules() => [.. BuiltInRules.All, NewRules()];

    /// <summary>Whether a scene, such as one that a host has sent, is this game.</summary>
    internal static bool IsOf(Scene scene) => scene.Rules is AirHockeyRules;

    /// <summary>The number of the player that a peer is; null if it only looks on.</summary>
    internal static int? PlayerAt(Scene scene, byte peer) =>
        peer - Table.PeerOf(scene, 0) is int player && player >= 0 && player < Table.PlayersOf(scene) ? player : null;

    /// <summary>Returns the rules, which each peer has an object of its own of.</summary>
    internal static GameRules NewRules() => new AirHockeyRules();

    /// <summary>The place of the table at a point that is seen.</summary>
    internal static Vector3D FromView(double x, double y) => new(x, 0, -y);

    /// <summary>Where a place of the table is seen.</summary>
    internal static (double X, double Y) ToView(in Vector3D place) => (place.X, -place.Z);
}
