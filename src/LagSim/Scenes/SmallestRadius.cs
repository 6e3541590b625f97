using System;
using System.Collections.Generic;

namespace LagSim.Scenes;

/// <summary>The smallest radius that a body of a scene has or may be spawned with, which bounds how fast any may be.</summary>
internal static class SmallestRadius
{
    /// <summary>What was promised; without a promise, that of the smallest body.</summary>
    /// <param name="bodies">The bodies of the scene.</param>
    /// <param name="promised">What was promised, in metres; null for nothing.</param>
    /// <exception cref="SceneException">A body is smaller than was promised.</exception>
    internal static double Of(List<SceneBody> bodies, double? promised)
    {
        double smallest = double.MaxValue;
        foreach (SceneBody body in bodies)
        {
            if (body.Spec.Radius < promised)
            {
                throw new SceneException($"The radius of {SceneBuilder.Whose(body)} is {Limits.Text(body.Spec.Radius)} m; the smallest radius of"
                    + $" the scene is {Limits.Text(promised.Value)} m, and must be at most that of every body.");
            }

            smallest = Math.Min(smallest, body.Spec.Radius);
        }

        return promised ?? (smallest == double.MaxValue ? Limits.MaxRadius : smallest);
    }
}
