using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Hands;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Hold;

/// <summary>The measurements of a session in which a hand holds and throws the ball.</summary>
/// <param name="Options">The options of the run.</param>
/// <param name="Seen">The errors among the peers as seen, at the same shared time. "After" means that no event is in transit.</param>
/// <param name="SeenTrueTime">The errors among the peers as seen, at the same true instant.</param>
/// <param name="Settled">The errors among the peers' timelines once every event has arrived.</param>
/// <param name="StateHashes">Each peer's state at the last sample, the host first.</param>
/// <param name="EventHashes">Each peer's hash of all events up to then.</param>
/// <param name="TruthStateHash">The reference's state at the last sample; it had every accepted event on time.</param>
/// <param name="TruthEventHash">The reference's hash of all events up to then.</param>
/// <param name="SceneHash">The hash of the scene.</param>
/// <param name="ClockErrorMilliseconds">The largest error of a shared clock.</param>
/// <param name="Events">The number of events in the host's world.</param>
/// <param name="Heals">How often peers rewound for a late event of the hand; 0 with a strategy that never rewinds.</param>
/// <param name="BytesSentPerSecond">Bytes per second sent by each peer over the whole run, UDP and IP headers included.</param>
/// <param name="Lateness">How late the hand's events arrived, in milliseconds after their stamp.</param>
/// <param name="CpuCoresAtRest">The processor use of the whole process at the end, in cores; null where it was not measured, for example
/// because the ball was still sliding.</param>
/// <param name="Keyframes">The number of keyframes that the hand sent.</param>
/// <param name="KeyframesPerSecond">The keyframes per second of the motion.</param>
/// <param name="HolderSentPerSecond">Bytes per second that the holder sent during the motion, headers included.</param>
/// <param name="HolderReceivedPerSecond">Bytes per second that the holder received during the motion, headers included.</param>
/// <param name="Own">How far from the hand its own peer showed the ball during the motion: the error of leaving out keyframes.</param>
/// <param name="Views">The views of the held ball by each other peer, in the order of their places.</param>
/// <param name="Accepted">The accepted events, in the order of the host's log.</param>
/// <param name="Trace">The samples, for charts.</param>
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
    /// <summary>All traffic on the holder's link during the motion, in bytes per second.</summary>
    public double HolderBytesPerSecond => HolderSentPerSecond + HolderReceivedPerSecond;

    /// <summary>Whether all peers' timelines agree with each other and with the reference, bit for bit.</summary>
    public bool Agrees =>
        new[] { Settled.Before, Settled.During, Settled.After }.Select(phase => phase.ToStatistics()).All(e => e.DifferingBits + e.StalledSamples == 0)
        && StateHashes.All(hash => hash == TruthStateHash) && EventHashes.All(hash => hash == TruthEventHash);
}

/// <summary>
/// The error of another peer's view of the held ball: its distance from the hand, during the motion, at the same shared time. Immutable.
/// </summary>
/// <param name="Peer">The viewer's place in the group; 0 is the host.</param>
/// <param name="Simulated">The error of the ball in that peer's world, which extrapolates the last keyframe by the fixed rule.</param>
/// <param name="Predicted">The error of a ball drawn by <see cref="Net.Display.AdaptivePredictor"/>.</param>
/// <param name="CandidateMetres">The rms error of each candidate predictor alone, from the same keyframes, in its order.</param>
public sealed record HeldView(int Peer, ErrorStatistics Simulated, ErrorStatistics Predicted, IReadOnlyList<double> CandidateMetres)
{
    /// <summary>The error of holding the last known position.</summary>
    public double HoldLastMetres => CandidateMetres[0];

    /// <summary>The error of extrapolating at the last known velocity.</summary>
    public double VelocityMetres => CandidateMetres[PredictionTest.VelocityCandidate];

    /// <summary>The index of the candidate with the least error.</summary>
    public int BestCandidate => Enumerable.Range(0, CandidateMetres.Count).MinBy(candidate => CandidateMetres[candidate]);

    /// <summary>The rms error of that candidate.</summary>
    public double BestInHindsightMetres => CandidateMetres[BestCandidate];

    /// <summary>The adaptive predictor's rms error divided by that; NaN where both are 0.</summary>
    public double RatioToBest => Predicted.RmsMetres / BestInHindsightMetres;
}

/// <summary>The positions of hand and ball, sample by sample, for charts and CSV.</summary>
/// <param name="Seconds">The shared time since the start of the scene, in seconds.</param>
/// <param name="Hand">The position of the hand; NaN before the grab and after the release.</param>
/// <param name="Balls">For each peer, the position of the ball it showed; NaN where it stalled.</param>
/// <param name="Drawn">For each view, the position of the ball drawn by the adaptive predictor; NaN where there is none.</param>
/// <param name="SeenError">The largest distance among the peers as seen, in metres.</param>
/// <param name="SettledError">The largest distance among the peers as settled, in metres.</param>
/// <param name="Grab">The time of the grab.</param>
/// <param name="MotionStart">The time at which the ball was lifted and the motion began.</param>
/// <param name="ThrowStart">The time at which the measured motion ended and the throw began.</param>
/// <param name="Release">The time of the release.</param>
/// <param name="Known">The time at which the last peer showed the release; null if one never did.</param>
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
