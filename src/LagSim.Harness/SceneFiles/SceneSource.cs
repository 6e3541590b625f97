using System;
using System.IO;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>What a user names as a scene: a built-in one, or a JSON file.</summary>
public static class SceneSource
{
    /// <summary>The built-in scene of that name, else the scene in that file.</summary>
    /// <remarks>A built-in name wins; a file of the same name is reached as <c>./drop</c>.</remarks>
    /// <exception cref="SceneFileException">It is neither, or the file holds no valid scene.</exception>
    public static Scene Load(string nameOrPath)
    {
        ArgumentNullException.ThrowIfNull(nameOrPath);
        if (BuiltInScenes.TryGet(nameOrPath, out Scene? scene))
        {
            return scene;
        }

        if (!File.Exists(nameOrPath) && !Directory.Exists(nameOrPath))
        {
            throw new SceneFileException(
                nameOrPath.Length == 0 ? "''" : JsonFault.Clip(nameOrPath, 300),
                "",
                0,
                $"this is neither a built-in scene ({BuiltInScenes.KnownNames}) nor a file that exists{CrowdScene.Hint(nameOrPath)}");
        }

        return SceneFile.Read(nameOrPath);
    }
}
