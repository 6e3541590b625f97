using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;

namespace LagSim.Harness.Experiments.Compare;

/// <summary>One strategy on one link, measured.</summary>
/// <param name="Options">With what.</param>
/// <param name="Seen">Errors as seen among the peers, at the same shared time. After means: no event is on its way to anybody.</param>
/// <param name="SeenTrueTime">Errors as seen among the peers, at the same true instant.</param>
/// <param name="SeenFromTruth">How far what the peers showed was from the world that had every accepted event on time, at the same shared
/// time.</param>
/// <param name="Settled">Errors among the peers of what the timelines say once every event has arrived.</param>
/// <param name="StateHashes">Each peer's state at the last sample, the host first.</param>
/// <param name="EventHashes">Each peer's hash of all events up to then.</param>
/// <param name="TruthStateHash">The state then of the world that had every accepted event on time.</param>
/// <param name="TruthEventHash">Its hash of all events up to then.</param>
/// <param name="ClockErrorMilliseconds">The largest error of a shared clock.</param>
/// <param name="Events">How many events the host's world went through.</param>
/// <param name="Heals">How often peers rewrote their past for another's event; 0 with a strategy that rewrites none.</param>
/// <param name="BytesSentPerSecond">Each peer's datagrams, UDP and IP headers included.</param>
/// <param name="Lateness">By how many milliseconds other peers' events came after their stamp.</param>
/// <param name="Divergence">For each event the milliseconds from its stamp until the last peer showed it: while the peers' pictures may
/// differ because of it.</param>
/// <param name="TimeToHeal"> Milliseconds of wall clock, not of virtual time, in which late events were healed: those of the step of a peer
/// that took it in, from its first datagram to the published picture. The only figures that depend on the machine.
/// </param>
/// <param name="EventsRerun">For each heal how many events were run again, the late one included.</param>
/// <param name="ConeBodies">For each heal how many bodies were predicted anew.</param>
/// <param name="Corrections">How far, in metres, bodies jumped that were drawn elsewhere than a moment before, at the same instant, because
/// a late event had come.</param>
/// <param name="CorrectionsSeen">How many such jumps there were.</param>
/// <param name="InputLatency">Milliseconds from a player's action until its own picture showed it, to the next sample.</param>
/// <param name="Trace">What there is to draw.</param>
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
    /// Where a peer first settled on another state of a body than the world that had every event on time; null if none did.
    /// </summary>
    public SettledDifference? FirstDifference { get; init; }

    /// <summary>Whether all peers settled on the same, and on what a world has that had every event on time, bit for bit.</summary>
    public bool Agrees =>
        new[] { Settled.Before, Settled.During, Settled.After }.Select(phase => phase.ToStatistics()).All(e => e.DifferingBits + e.StalledSamples == 0)
        && StateHashes.All(hash => hash == TruthStateHash) && EventHashes.All(hash => hash == TruthEventHash);
}

/// <summary>A body that a peer settled on otherwise. Immutable.</summary>
/// <param name="Seconds">At which sample, in seconds since the start.</param>
/// <param name="Peer">Whose: the place in the group, 0 is the host.</param>
/// <param name="Body">The body's name in the scene, or its number if it was spawned.</param>
public sealed record SettledDifference(double Seconds, int Peer, string Body);

/// <summary>The distances of a run, sample by sample, for charts and CSV.</summary>
/// <param name="Seconds">Shared time since the start of the scene.</param>
/// <param name="SeenError">The largest distance among the peers as seen, in metres; NaN where one stalled.</param>
/// <param name="SeenFromTruth">The largest distance from the world that had every event on time.</param>
/// <param name="SettledError">The largest distance among the peers as settled.</param>
/// <param name="Events">Of each event, in order, its stamp and when the last peer showed it; null if one never did.</param>
public sealed record CompareTrace(
    double[] Seconds, double[] SeenError, double[] SeenFromTruth, double[] SettledError, IReadOnlyList<(double Stamp, double? Dealt)> Events);
