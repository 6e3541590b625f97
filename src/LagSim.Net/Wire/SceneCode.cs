using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Net.Wire;

/// <summary>The code of a program's own that a scene may need and that does not travel: accelerations and rules, found by name and author's
/// version.</summary>
internal readonly struct SceneCode(IReadOnlyList<IAcceleration>? accelerations, IReadOnlyList<SceneRules>? rules)
{
    /// <summary>The accelerations at hand; null for none.</summary>
    internal IReadOnlyList<IAcceleration>? Accelerations { get; } = accelerations;

    /// <summary>The rules at hand; null for none.</summary>
    internal IReadOnlyList<SceneRules>? Rules { get; } = rules;

    /// <summary>What is at hand, or where nothing is, what a scene has.</summary>
    internal SceneCode Or(Scene? scene) => new(
        Accelerations ?? scene?.Accelerations, Rules ?? (scene?.Rules is SceneRules own ? new[] { own } : null));
}
