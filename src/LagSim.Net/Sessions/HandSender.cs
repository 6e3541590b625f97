using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
///  Says when the others must hear of a hand that holds a body: when what they foretell of it from the last keyframe is off by more than a
/// set distance.
/// </summary>
/// <remarks>
/// <para>It replays <see cref="HandPath"/>, by which every peer extrapolates, so bandwidth follows surprise. The same samples give the same
/// keyframes. For one hand from one grab to its release, on one thread. What is done is stamped when it is done, so a keyframe is to be
/// done at once.</para>
/// <para>As <c>if (sender.TrySample(now, hand, speed, out PlayerAction keyframe)) { session.Do(keyframe); }</c>, each frame, from the grab
/// on.</para>
/// </remarks>
public sealed class HandSender
{
    private readonly BodyId body;
    private readonly HandSenderOptions options;
    private bool hasSent;
    private SimTime sent;
    private Vector3D sentPosition;
    private Vector3D sentVelocity;

    /// <summary>For a hand that takes this body now.</summary>
    /// <param name="body">What it holds.</param>
    /// <param name="options">How far off, how often; copied.</param>
    /// <exception cref="ArgumentOutOfRangeException">An option is out of its range.</exception>
    public HandSender(BodyId body, HandSenderOptions? options = null)
    {
        this.body = body;
        this.options = (options ?? new HandSenderOptions()).Checked();
    }

    /// <summary>How many keyframes were due so far.</summary>
    public long Keyframes { get; private set; }

    /// <summary>
    ///  The greatest distance in metres by which a sample was off from what the others foretold, those included that a keyframe was due
    /// for; of the first none.
    /// </summary>
    public double GreatestError { get; private set; }

    /// <summary>Takes where the hand is, and says whether the others must hear of it.</summary>
    /// <param name="time">When, in shared time; not before the sample before.</param>
    /// <param name="position">The hand's point, in metres.</param>
    /// <param name="velocity">Its velocity, in m/s, as well as it is known: the better, the fewer keyframes.</param>
    /// <param name="keyframe">What to do in the session now, if it is due; else the default.</param>
    /// <returns>Whether a keyframe is due: for the first sample always.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The time is before that of the sample for which a keyframe was due last.</exception>
    public bool TrySample(SimTime time, in Vector3D position, in Vector3D velocity, out PlayerAction keyframe)
    {
        if (hasSent && time < sent)
        {
            throw new ArgumentOutOfRangeException(nameof(time), time.ToShortString(), $"A keyframe of {sent.ToShortString()} was sent already; samples come in the"
                + " order of their times.");
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
            Keyframes++;
        }

        keyframe = isDue ? PlayerAction.HoldKeyframe(body, position, velocity) : default;
        return isDue;
    }
}
