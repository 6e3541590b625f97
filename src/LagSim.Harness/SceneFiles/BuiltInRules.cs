using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>The rules that the tool has: what its clients can supply, and recordings and scene files name.</summary>
public static class BuiltInRules
{
    /// <summary>All of them.</summary>
    public static IReadOnlyList<SceneRules> All { get; } = [new GoalsRules()];

    /// <summary>Their names in words, for error messages.</summary>
    internal static string KnownNames => string.Join(", ", All.Select(rules => rules.Name));

    /// <summary>The rules of a name; null if there are none.</summary>
    internal static SceneRules? Named(string name) => All.FirstOrDefault(rules => rules.Name == name);
}
