using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// Decides when to send a keyframe for a hand that holds a body: when the other peers' extrapolation from the last keyframe is off by more
/// than a set distance.
/// </summary>
/// <remarks>
/// <para>It replays <see cref="HandPath"/>, by which every peer extrapolates, so bandwidth is spent only on surprises. The same samples
/// give the same keyframes. For one hand from a grab to its release, on one thread. Actions are stamped when they are done, so perform a
/// keyframe at once.</para>
/// <para>Use it as <c>if (sender.TrySample(now, hand, speed, out PlayerAction keyframe)) { session.Do(keyframe); }</c>, each frame, from
/// the grab on.</para>
/// </remarks>
public sealed class HandSender
{
    private readonly BodyId body;
    private readonly HandSenderOptions options;
    private bool hasSent;
    private SimTime sent;
    private Vector3D sentPosition;
    private Vector3D sentVelocity;

    /// <summary>Creates a sender for a hand that grabs this body now.</summary>
    /// <param name="body">The held body.</param>
    /// <param name="options">The tolerance and rates; copied.</param>
    /// <exception cref="ArgumentOutOfRangeException">An option is out of range.</exception>
    public HandSender(BodyId body, HandSenderOptions? options = null)
    {
        this.body = body;
        this.options = (options ?? new HandSenderOptions()).Checked();
    }

    /// <summary>The number of keyframes that were due so far.</summary>
    public long KeyframesSent { get; private set; }

    /// <summary>
    /// The greatest distance in metres between a sample and the other peers' prediction of it, samples that caused a keyframe included; the
    /// first sample has no prediction.
    /// </summary>
    public double GreatestError { get; private set; }

    /// <summary>Takes a sample of the hand, and returns whether a keyframe must be sent.</summary>
    /// <param name="time">The time of the sample, in shared time; not before the previous sample.</param>
    /// <param name="position">The hand's point, in metres.</param>
    /// <param name="velocity">Its velocity, in m/s, as accurate as possible: the better, the fewer keyframes.</param>
    /// <param name="keyframe">The action to perform in the session now, if one is due; otherwise the default.</param>
    /// <returns>Whether a keyframe is due; always true for the first sample.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The time is before that of the last sample for which a keyframe was due.</exception>
    public bool TrySample(SimTime time, in Vector3D position, in Vector3D velocity, out PlayerAction keyframe)
    {
        if (hasSent && time < sent)
        {
            throw new ArgumentOutOfRangeException(nameof(time), time.ToShortString(), $"A keyframe of {sent.ToShortString()} was sent already; samples come in the"
                + " order of their times.");
        }

        if (!position.IsFinite || !velocity.IsFinite)
        {
            throw new ArgumentOutOfRangeException(
                position.IsFinite ? nameof(velocity) : nameof(position), position.IsFinite ? velocity : position, "Where a hand is, and how fast, are finite numbers.");
        }

        SimDuration since = hasSent ? time - sent : SimDuration.MaxValue;
        double error = hasSent ? (HandPath.Position(sentPosition, sentVelocity, since) - position).Length : 0;
        GreatestError = Math.Max(GreatestError, error);
        bool isDue = since >= options.Longest || (error > options.Distance && since >= options.Shortest);
        if (isDue)
        {
            hasSent = true;
            sent = time;
            sentPosition = position;
            sentVelocity = velocity;
            KeyframesSent++;
        }

        keyframe = isDue ? PlayerAction.HoldKeyframe(body, position, velocity) : default;
        return isDue;
    }
}
