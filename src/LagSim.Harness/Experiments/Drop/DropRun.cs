using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;

namespace LagSim.Harness.Experiments.Drop;

/// <summary>One case of a drop test, measured.</summary>
/// <param name="Case">Which.</param>
/// <param name="Options">With what.</param>
/// <param name="Seen">Errors as seen, at the same shared time.</param>
/// <param name="SeenTrueTime">Errors as seen, at the same true instant.</param>
/// <param name="Settled">Errors of what the timelines say once every event has arrived.</param>
/// <param name="StateHashes">Each peer's state at the case's last sample, the host first.</param>
/// <param name="EventHashes">Each peer's hash of all events up to then: the state at the end of a case is rest, this is how it got
/// there.</param>
/// <param name="SceneHash">The scene's.</param>
/// <param name="ClockErrorMilliseconds">The largest error of a shared clock.</param>
/// <param name="Events">How many events the host's world went through in this case.</param>
/// <param name="Heals">How often peers rewrote their timelines back to another's event that came late; 0 with a strategy that rewrites no
/// past.</param>
/// <param name="BytesSentPerSecond">Each peer's datagrams, UDP and IP headers included; what a carrier adds of its own is not.</param>
/// <param name="Lateness">By how many milliseconds other peers' events came after their stamp.</param>
/// <param name="CpuCoresAtRest">Processor use of the whole process while all rests; null where not measured.</param>
/// <param name="BallRested">Whether the ball was at rest when it was lifted; true of a case without a lift.</param>
/// <param name="Trace">What there is to draw.</param>
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
    /// Whether all peers' timelines and hashes agree to the bit, before and after the event and at the time of it, and nothing was missed.
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
/// <param name="Seconds">Shared time since the start of the scene.</param>
/// <param name="Heights">For each peer what it showed, in metres; NaN where it stalled.</param>
/// <param name="SettledHeights">For each peer what its timelines say in the end.</param>
/// <param name="SeenError">The distance as seen at the same shared time.</param>
/// <param name="SeenTrueTimeError">The distance as seen at the same true instant.</param>
/// <param name="SettledError">The distance as settled.</param>
/// <param name="Impacts">When the host's ball hit the floor, as settled.</param>
/// <param name="Lift">When the ball was lifted; null if it was not.</param>
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
