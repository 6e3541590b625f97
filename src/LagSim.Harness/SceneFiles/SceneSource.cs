using System;
using System.IO;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>The scene that a user names: a built-in one, or a JSON file.</summary>
public static class SceneSource
{
    /// <summary>Returns the built-in scene of a name, else reads the file.</summary>
    /// <param name="nameOrPath">The name or the path.</param>
    /// <param name="other">Another name that the caller knows, which an error lists with those of the built-in scenes; null for none.</param>
    /// <remarks>A built-in name wins; a file of the same name is reached as <c>./drop</c>.</remarks>
    /// <exception cref="SceneFileException">The name is no built-in scene, and the file does not exist or holds no valid scene.</exception>
    public static Scene Load(string nameOrPath, string? other = null)
    {
        ArgumentNullException.ThrowIfNull(nameOrPath);
        if (BuiltInScenes.TryGet(nameOrPath, out Scene? scene))
        {
            return scene;
        }

        if (!File.Exists(nameOrPath) && !Directory.Exists(nameOrPath))
        {
            string others = other is null ? "" : $", {other}";
            throw new SceneFileException(
                nameOrPath.Length == 0 ? "''" : JsonFault.Clip(nameOrPath, 300),
                "",
                0,
                $"this is neither a built-in scene ({BuiltInScenes.KnownNames}{others}) nor a file that exists{CrowdScene.Hint(nameOrPath)}");
        }

        return SceneFile.Read(nameOrPath);
    }
}
