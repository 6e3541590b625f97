using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>A session in which a hand holds and throws the ball, measured.</summary>
/// <param name="Options">With what.</param>
/// <param name="Seen">Errors as seen among the peers, at the same shared time. After means: no event is on its way to anybody.</param>
/// <param name="SeenTrueTime">Errors as seen among the peers, at the same true instant.</param>
/// <param name="Settled">Errors among the peers of what the timelines say once every event has arrived.</param>
/// <param name="StateHashes">Each peer's state at the last sample, the host first.</param>
/// <param name="EventHashes">Each peer's hash of all events up to then.</param>
/// <param name="TruthStateHash">The state then of the world that had every accepted event on time.</param>
/// <param name="TruthEventHash">Its hash of all events up to then.</param>
/// <param name="SceneHash">The scene's.</param>
/// <param name="ClockErrorMilliseconds">The largest error of a shared clock.</param>
/// <param name="Events">How many events the host's world went through.</param>
/// <param name="Heals">How often peers rewrote their past for an event of the hand that came late; 0 with a strategy that rewrites
/// none.</param>
/// <param name="BytesSentPerSecond">Each peer's datagrams over the whole run, UDP and IP headers included.</param>
/// <param name="Lateness">By how many milliseconds the hand's events came after their stamp.</param>
/// <param name="CpuCoresAtRest">Processor use of the whole process at the end; null where not measured, as where the ball slides
/// on.</param>
/// <param name="Keyframes">How often the hand told where it is.</param>
/// <param name="KeyframesPerSecond">The same for each second of the motion.</param>
/// <param name="HolderSentPerSecond">Bytes a second that the peer whose hand it is sent while the motion went on, headers included.</param>
/// <param name="HolderReceivedPerSecond">Bytes a second that came in there meanwhile.</param>
/// <param name="Own">How far from the hand its own peer showed the ball during the motion: what keyframes leave out.</param>
/// <param name="Views">What each of the others saw of the held ball, in the order of their places.</param>
/// <param name="Accepted">What the host accepted, in the order of its log.</param>
/// <param name="Trace">What there is to draw.</param>
public sealed record HoldRun(
    HoldOptions Options,
    PhaseErrors Seen,
    PhaseErrors SeenTrueTime,
    PhaseErrors Settled,
    IReadOnlyList<ulong> StateHashes,
    IReadOnlyList<ulong> EventHashes,
    ulong TruthStateHash,
    ulong TruthEventHash,
    ulong SceneHash,
    double ClockErrorMilliseconds,
    long Events,
    long Heals,
    IReadOnlyList<double> BytesSentPerSecond,
    Percentiles Lateness,
    double? CpuCoresAtRest,
    long Keyframes,
    double KeyframesPerSecond,
    double HolderSentPerSecond,
    double HolderReceivedPerSecond,
    ErrorStatistics Own,
    IReadOnlyList<HeldView> Views,
    IReadOnlyList<ExternalEvent> Accepted,
    HoldTrace Trace) : IPeerRun
{
    /// <summary>All that went over the holder's link while the motion went on, bytes a second.</summary>
    public double HolderBytesPerSecond => HolderSentPerSecond + HolderReceivedPerSecond;

    /// <summary>Whether all peers settled on the same, and on what a world has that had every event on time, bit for bit.</summary>
    public bool Agrees =>
        new[] { Settled.Before, Settled.During, Settled.After }.Select(phase => phase.ToStatistics()).All(e => e.DifferingBits + e.StalledSamples == 0)
        && StateHashes.All(hash => hash == TruthStateHash) && EventHashes.All(hash => hash == TruthEventHash);
}

/// <summary>
/// How far from the hand another peer saw the ball that it holds, during the motion and at the same shared time. Immutable.
/// </summary>
/// <param name="Peer">Whose view: the place in the group, 0 is the host.</param>
/// <param name="Simulated">Of the ball as that peer's world has it: the last keyframe foretold by the fixed rule.</param>
/// <param name="Predicted">Of a ball drawn where <see cref="Net.Display.AdaptivePredictor"/> tells that the hand is.</param>
/// <param name="CandidateMetres">Rms errors of each predictor that it mixes, alone, from the same keyframes; in its order.</param>
public sealed record HeldView(int Peer, ErrorStatistics Simulated, ErrorStatistics Predicted, IReadOnlyList<double> CandidateMetres)
{
    /// <summary>Of drawing it where the hand was last known to be.</summary>
    public double HoldLastMetres => CandidateMetres[0];

    /// <summary>Of letting it go on at the velocity last known.</summary>
    public double VelocityMetres => CandidateMetres[PredictionTest.VelocityCandidate];

    /// <summary>Which of them turned out to be best.</summary>
    public int BestCandidate => Enumerable.Range(0, CandidateMetres.Count).MinBy(candidate => CandidateMetres[candidate]);

    /// <summary>Its rms error.</summary>
    public double BestInHindsightMetres => CandidateMetres[BestCandidate];

    /// <summary>The adaptive predictor's rms error over that; NaN where neither errs.</summary>
    public double RatioToBest => Predicted.RmsMetres / BestInHindsightMetres;
}

/// <summary>Where hand and ball were, sample by sample, for charts and CSV.</summary>
/// <param name="Seconds">Shared time since the start of the scene.</param>
/// <param name="Hand">Where the hand was; NaN before the grab and after the release.</param>
/// <param name="Balls">For each peer where it showed the ball; NaN where it stalled.</param>
/// <param name="Drawn">For each view where the adaptive predictor would have the ball drawn; NaN where there is none to draw.</param>
/// <param name="SeenError">The largest distance among the peers as seen.</param>
/// <param name="SettledError">The same as settled.</param>
/// <param name="Grab">When the hand closed.</param>
/// <param name="MotionStart">When the ball was lifted and the motion began.</param>
/// <param name="ThrowStart">When the motion ended, as far as it is measured, and the throw began.</param>
/// <param name="Release">When the hand opened.</param>
/// <param name="Known">When the last peer showed the release; null if one never did.</param>
public sealed record HoldTrace(
    double[] Seconds,
    Vector3D[] Hand,
    Vector3D[][] Balls,
    Vector3D[][] Drawn,
    double[] SeenError,
    double[] SettledError,
    double Grab,
    double MotionStart,
    double ThrowStart,
    double Release,
    double? Known);
