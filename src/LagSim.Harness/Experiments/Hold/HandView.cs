using System.Collections.Generic;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Net.Display;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>
/// Where a player's screen would draw another's hand by <see cref="AdaptivePredictor"/>, from the keyframes that have come and from those
/// that have not.
/// </summary>
/// <remarks>
/// That no keyframe came tells something too: until now less what a keyframe takes, the hand was where the others foretell it, give or take
/// the sender's distance. So each frame gives the predictor a sample that is as old as the slowest of the newest keyframes was, but never
/// older than the newest keyframe itself, on <see cref="HandPath"/>. Keyframes alone, at uneven times, would teach it little. For display
/// only; not thread-safe.
/// </remarks>
internal sealed class HandView
{
    /// <summary>So many keyframes say how late they come; tried, as all of this, on seeds 1001 to 1004.</summary>
    private const int Remembered = 16;

    /// <summary>Samples that are nearer together than this, about a tracker's rate, teach nothing more.</summary>
    private static readonly SimDuration Apart = SimDuration.FromMilliseconds(8);

    private readonly AdaptivePredictor predictor = new();
    private readonly List<HandUpdate> keyframes = [];

    /// <summary>A keyframe has come.</summary>
    internal void Hear(in HandUpdate keyframe) => keyframes.Add(keyframe);

    /// <summary>Where the hand is drawn in a frame; false before any keyframe. Frames come in the order of their times.</summary>
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

    /// <summary>Where one of the predictors that are mixed would draw it, alone, in the frame that was drawn last.</summary>
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

    /// <summary>What is foretold of an instant at or after the newest keyframe.</summary>
    private (Vector3D Position, Vector3D Velocity) Known(SimTime time)
    {
        ExternalEvent newest = keyframes[^1].Event;
        SimDuration since = time - newest.Time;
        return (HandPath.Position(newest.Position, newest.Velocity, since), HandPath.Velocity(newest.Velocity, since));
    }
}
