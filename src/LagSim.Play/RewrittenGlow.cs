using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Play;

/// <summary>How much each body glows because its path was just rewritten.</summary>
/// <remarks>Not thread-safe. Times are those of the person who looks, in seconds.</remarks>
internal sealed class RewrittenGlow
{
    /// <summary>How long a body glows: long enough that nothing flashes more than three times a second.</summary>
    private const double Seconds = 0.35;

    private readonly Dictionary<BodyId, double> until = [];

    /// <summary>Returns how much a body glows at a time, 1 to 0.</summary>
    /// <param name="body">The body.</param>
    /// <param name="isRewritten">Whether its path was rewritten since the frame before.</param>
    /// <param name="now">The time.</param>
    internal double Of(BodyId body, bool isRewritten, double now)
    {
        if (isRewritten)
        {
            until[body] = now + Seconds;
        }

        return until.TryGetValue(body, out double end) ? Math.Clamp((end - now) / Seconds, 0, 1) : 0;
    }

    /// <summary>Nothing glows any more.</summary>
    internal void Clear() => until.Clear();
}
