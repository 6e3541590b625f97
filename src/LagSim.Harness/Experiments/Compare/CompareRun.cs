using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>The measurements of one strategy on one link.</summary>
/// <param name="Options">The options of the run.</param>
/// <param name="Seen">The errors among the peers as seen, at the same shared time. "After" means that no event is in transit.</param>
/// <param name="SeenTrueTime">The errors among the peers as seen, at the same true instant.</param>
/// <param name="SeenFromTruth">The errors as seen against the reference, which had every accepted event on time, at the same shared
/// time.</param>
/// <param name="Settled">The errors among the peers' timelines once every event has arrived.</param>
/// <param name="StateHashes">Each peer's state at the last sample, the host first.</param>
/// <param name="EventHashes">Each peer's hash of all events up to then.</param>
/// <param name="TruthStateHash">The reference's state at the last sample.</param>
/// <param name="TruthEventHash">The reference's hash of all events up to then.</param>
/// <param name="ClockErrorMilliseconds">The largest error of a shared clock.</param>
/// <param name="Events">The number of events in the host's world.</param>
/// <param name="Heals">How often peers rewound for another peer's event; 0 with a strategy that never rewinds.</param>
/// <param name="BytesSentPerSecond">Bytes per second sent by each peer, UDP and IP headers included.</param>
/// <param name="Lateness">How late other peers' events arrived, in milliseconds after their stamp.</param>
/// <param name="Divergence">For each event, the milliseconds from its stamp until the last peer showed it. Until then the peers' frames may
/// differ because of it.</param>
/// <param name="TimeToHeal">Wall-clock milliseconds of the steps in which late events were healed, from the first datagram to the published
/// frame. The only figures that depend on the machine.</param>
/// <param name="EventsRerun">For each heal, the number of events that were re-simulated, the late one included.</param>
/// <param name="ConeBodies">For each heal, the number of bodies that were predicted again.</param>
/// <param name="Corrections">How far, in metres, bodies jumped on screen because of a late event: the distance between the old and the new
/// frame at the same instant.</param>
/// <param name="CorrectionsSeen">The number of such jumps.</param>
/// <param name="InputLatency">The milliseconds from a player's action until its own frame showed it, rounded up to the next sample.</param>
/// <param name="Trace">The samples, for charts.</param>
public sealed record CompareRun(
    CompareOptions Options,
    PhaseErrors Seen,
    PhaseErrors SeenTrueTime,
    PhaseErrors SeenFromTruth,
    PhaseErrors Settled,
    IReadOnlyList<ulong> StateHashes,
    IReadOnlyList<ulong> EventHashes,
    ulong TruthStateHash,
    ulong TruthEventHash,
    double ClockErrorMilliseconds,
    long Events,
    long Heals,
    IReadOnlyList<double> BytesSentPerSecond,
    Percentiles Lateness,
    Percentiles Divergence,
    Percentiles TimeToHeal,
    MeanAndTail EventsRerun,
    MeanAndTail ConeBodies,
    Percentiles Corrections,
    long CorrectionsSeen,
    Percentiles InputLatency,
    CompareTrace Trace) : IPeerRun
{
    /// <summary>
    /// The first state of a body on which a peer's timelines differ from the reference; null if none does.
    /// </summary>
    public SettledDifference? FirstDifference { get; init; }

    /// <summary>Whether all peers' timelines agree with each other and with the reference, bit for bit.</summary>
    public bool Agrees =>
        new[] { Settled.Before, Settled.During, Settled.After }.Select(phase => phase.ToStatistics()).All(e => e.DifferingBits + e.StalledSamples == 0)
        && StateHashes.All(hash => hash == TruthStateHash) && EventHashes.All(hash => hash == TruthEventHash);
}

/// <summary>A settled difference between a peer and the reference. Immutable.</summary>
/// <param name="Seconds">The time of the sample, in seconds since the start.</param>
/// <param name="Peer">The peer's place in the group; 0 is the host.</param>
/// <param name="Body">The body's name in the scene, or its number if it was spawned.</param>
public sealed record SettledDifference(double Seconds, int Peer, string Body);

/// <summary>The distances of a run, sample by sample, for charts and CSV.</summary>
/// <param name="Seconds">The shared time since the start of the scene, in seconds.</param>
/// <param name="SeenError">The largest distance among the peers as seen, in metres; NaN where one stalled.</param>
/// <param name="SeenFromTruth">The largest distance from the reference, in metres.</param>
/// <param name="SettledError">The largest distance among the peers' timelines, in metres.</param>
/// <param name="Events">For each event, in order, its stamp and when the last peer showed it; null if one never did.</param>
public sealed record CompareTrace(
    double[] Seconds, double[] SeenError, double[] SeenFromTruth, double[] SettledError, IReadOnlyList<(double Stamp, double? Dealt)> Events);
