using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;

namespace LagSim.Harness.Experiments.Drop;

/// <summary>The measurements of one case of a drop test.</summary>
/// <param name="Case">The case.</param>
/// <param name="Options">The options of the run.</param>
/// <param name="Seen">The errors as seen, at the same shared time.</param>
/// <param name="SeenTrueTime">The errors as seen, at the same true instant.</param>
/// <param name="Settled">The errors among the timelines once every event has arrived.</param>
/// <param name="StateHashes">Each peer's state at the case's last sample, the host first.</param>
/// <param name="EventHashes">Each peer's hash of all events up to then. The state at the end of a case is rest; the hash covers how it got
/// there.</param>
/// <param name="SceneHash">The hash of the scene.</param>
/// <param name="ClockErrorMilliseconds">The largest error of a shared clock.</param>
/// <param name="Events">The number of events in the host's world in this case.</param>
/// <param name="Heals">How often peers rewound for another peer's late event; 0 with a strategy that never rewinds.</param>
/// <param name="BytesSentPerSecond">Bytes per second sent by each peer, UDP and IP headers included, without overhead of other
/// carriers.</param>
/// <param name="Lateness">How late other peers' events arrived, in milliseconds after their stamp.</param>
/// <param name="CpuCoresAtRest">The processor use of the whole process at rest, in cores; null where it was not measured.</param>
/// <param name="BallRested">Whether the ball was at rest when it was lifted; true of a case without a lift.</param>
/// <param name="Trace">The samples, for charts.</param>
public sealed record DropRun(
    DropCase Case,
    DropOptions Options,
    PhaseErrors Seen,
    PhaseErrors SeenTrueTime,
    PhaseErrors Settled,
    IReadOnlyList<ulong> StateHashes,
    IReadOnlyList<ulong> EventHashes,
    ulong SceneHash,
    double ClockErrorMilliseconds,
    long Events,
    long Heals,
    IReadOnlyList<double> BytesSentPerSecond,
    Percentiles Lateness,
    double? CpuCoresAtRest,
    bool BallRested,
    DropTrace Trace) : IPeerRun
{
    /// <summary>
    /// Whether all peers' timelines and hashes agree to the bit before, during and after the event, and no sample is missing.
    /// </summary>
    public bool Agrees =>
        Differing(Settled.Before) + Differing(Settled.During) + Differing(Settled.After) == 0 && StateHashes.Distinct().Count() == 1
        && EventHashes.Distinct().Count() == 1;

    private static long Differing(ErrorAccumulator errors)
    {
        ErrorStatistics statistics = errors.ToStatistics();
        return statistics.DifferingBits + statistics.StalledSamples;
    }
}

/// <summary>The heights and distances of a case, sample by sample, for charts and CSV.</summary>
/// <param name="Seconds">The shared time since the start of the scene, in seconds.</param>
/// <param name="Heights">For each peer, the height it showed, in metres; NaN where it stalled.</param>
/// <param name="SettledHeights">For each peer, the settled height, in metres.</param>
/// <param name="SeenError">The distance as seen at the same shared time, in metres.</param>
/// <param name="SeenTrueTimeError">The distance as seen at the same true instant, in metres.</param>
/// <param name="SettledError">The distance as settled, in metres.</param>
/// <param name="Impacts">The times at which the host's ball hit the floor, as settled.</param>
/// <param name="Lift">The time of the lift; null if there was none.</param>
/// <param name="Dealt">When the last peer had dealt with it.</param>
public sealed record DropTrace(
    double[] Seconds,
    double[][] Heights,
    double[][] SettledHeights,
    double[] SeenError,
    double[] SeenTrueTimeError,
    double[] SettledError,
    double[] Impacts,
    double? Lift,
    double? Dealt);
