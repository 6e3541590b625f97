using System;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>
/// One stroke of a hand: from rest to rest along a straight line with the least jerk (Flash and Hogan 1985), 10 s^3 - 15 s^4 + 6 s^5 of the
/// way.
/// </summary>
/// <remarks>Immutable. Polynomials alone, so the same bits everywhere.</remarks>
internal readonly record struct MinimumJerkStroke(double Start, double Duration, Vector3D Way)
{
    internal double End => Start + Duration;

    /// <summary>How far along it is at a time in seconds: nothing before its start, all of it after its end.</summary>
    internal Vector3D At(double time)
    {
        double s = Math.Min(Math.Max((time - Start) / Duration, 0), 1);
        return Way * (s * s * s * (10 - (s * (15 - (6 * s)))));
    }
}
