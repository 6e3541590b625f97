using System.Collections.Generic;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>
/// A view of a remote hand drawn by <see cref="AdaptivePredictor"/>, from the keyframes that arrived and from those that did not.
/// </summary>
/// <remarks>
/// A missing keyframe is information too: up to now minus a keyframe's latency, the hand was where the other peers extrapolate it, within
/// the sender's tolerance. So each frame gives the predictor a sample on <see cref="HandPath"/> that is as old as the slowest recent
/// keyframe was, but not older than the newest keyframe. Keyframes alone, at uneven times, would train it poorly. For display only; not
/// thread-safe.
/// </remarks>
internal sealed class HandView
{
    /// <summary>The number of recent keyframes that determine the latency; chosen on seeds 1001 to 1004.</summary>
    private const int Remembered = 16;

    /// <summary>The least interval of samples, about a tracker's; closer ones add nothing.</summary>
    private static readonly SimDuration Apart = SimDuration.FromMilliseconds(8);

    private readonly AdaptivePredictor predictor = new();
    private readonly List<HandUpdate> keyframes = [];

    /// <summary>Adds a received keyframe.</summary>
    internal void Hear(in HandUpdate keyframe) => keyframes.Add(keyframe);

    /// <summary>Returns the position to draw in a frame; false before any keyframe. Call it in order of frame times.</summary>
    internal bool TryDraw(SimTime now, out Vector3D drawn)
    {
        if (keyframes.Count > 0)
        {
            SimTime known = SimTime.Max(now - Lateness(), keyframes[^1].Event.Time);
            if (!predictor.HasSamples || known - predictor.NewestSample >= Apart)
            {
                (Vector3D position, Vector3D velocity) = Known(known);
                predictor.Add(known, position, velocity);
            }
        }

        return predictor.TryPredict(now, out drawn);
    }

    /// <summary>Returns the position that one candidate predictor alone would give, in the last drawn frame.</summary>
    internal Vector3D DrawnBy(int candidate, SimTime now)
    {
        predictor.TryPredict(now, candidate, out Vector3D drawn);
        return drawn;
    }

    private SimDuration Lateness()
    {
        SimDuration most = SimDuration.Zero;
        for (int n = keyframes.Count - 1; n >= 0 && n >= keyframes.Count - Remembered; n--)
        {
            SimDuration late = keyframes[n].Heard - keyframes[n].Event.Time;
            most = late > most ? late : most;
        }

        return most;
    }

    /// <summary>Returns the extrapolated position at or after the newest keyframe.</summary>
    private (Vector3D Position, Vector3D Velocity) Known(SimTime time)
    {
        ExternalEvent newest = keyframes[^1].Event;
        SimDuration since = time - newest.Time;
        return (HandPath.Position(newest.Position, newest.Velocity, since), HandPath.Velocity(newest.Velocity, since));
    }
}
