using System;
using LagSim.Scenes;

namespace LagSim;

/// <summary>Asks what a scene makes the engine do.</summary>
public static class SceneExplanations
{
    /// <summary>Explains what is simulated for the scene, what is left out, and why.</summary>
    /// <remarks>
    /// A pure function, safe on any thread. Cost: that of a <see cref="Simulation"/> of the scene at its start. For reports; allocates.
    /// </remarks>
    /// <exception cref="ArgumentNullException">The scene is null.</exception>
    public static SceneExplanation Explain(this Scene scene) => SceneExplanation.Of(scene ?? throw new ArgumentNullException(nameof(scene)));
}
