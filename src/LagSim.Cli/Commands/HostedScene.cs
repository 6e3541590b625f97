using LagSim.Harness.SceneFiles;
using LagSim.Play;
using LagSim.Scenes;

namespace LagSim.Cli.Commands;

/// <summary>A scene that a host can open: one that all commands know, or the game of two players that has rules of its own, at whose host nobody plays.</summary>
internal static class HostedScene
{
    internal static readonly string Text =
        $"A built-in scene's name ({BuiltInScenes.KnownNames}), a JSON file (see 'lagsim scenes'), or {AirHockeyGame.Name}, a game for two who join.";

    /// <exception cref="SceneFileException">There is no such scene, or the file holds no valid one.</exception>
    internal static Scene Load(string text, ulong seed) => text == AirHockeyGame.Name
        ? AirHockeyGame.Build(AirHockeyGame.Players, seed, isDedicated: true)
        : SceneSource.Load(text, AirHockeyGame.Name);

    /// <summary>How many must have joined before it starts, if nobody says so.</summary>
    internal static int ExpectedClients(Scene scene) => AirHockeyGame.IsOf(scene) ? AirHockeyGame.Players : 0;
}
