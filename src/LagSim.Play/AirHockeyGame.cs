using AirHockey;
using LagSim.Rules;
using LagSim.Scenes;

namespace LagSim.Play;

/// <summary>Air hockey as a page plays it: the table and the rules of <c>samples/AirHockey</c>, seen from above.</summary>
/// <remarks>What one player does and sees of it is an <see cref="AirHockeyPlayer"/>.</remarks>
internal static class AirHockeyGame
{
    /// <summary>The scene's name, as a link to the page has it.</summary>
    internal const string Name = "air-hockey";

    /// <summary>Half of what is seen of the table's length, in metres: a goal is behind each end.</summary>
    internal const double HalfViewLength = Table.HalfLength + 0.17;

    /// <summary>Half of what is seen of the table's width, in metres.</summary>
    internal const double HalfViewWidth = Table.HalfWidth + 0.07;

    /// <summary>Returns the table for so many players, 2 to 4, the first of them the host; prizes and serves are drawn by the seed.</summary>
    internal static Scene Build(int players, ulong seed) => Table.Build(players, NewRules(), seed);

    /// <summary>Returns the rules, which each peer has an object of its own of.</summary>
    internal static GameRules NewRules() => new AirHockeyRules();

    /// <summary>The place of the table at a point that is seen.</summary>
    internal static Vector3D FromView(double x, double y) => new(x, 0, -y);

    /// <summary>Where a place of the table is seen.</summary>
    internal static (double X, double Y) ToView(in Vector3D place) => (place.X, -place.Z);
}
