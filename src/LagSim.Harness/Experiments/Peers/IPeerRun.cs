using System.Collections.Generic;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>What every run of a group of peers tells, whatever was played.</summary>
public interface IPeerRun
{
    /// <summary>Errors as seen, at the same shared time.</summary>
    PhaseErrors Seen { get; }

    /// <summary>Errors as seen, at the same true instant.</summary>
    PhaseErrors SeenTrueTime { get; }

    /// <summary>Errors of what the timelines say once every event has arrived.</summary>
    PhaseErrors Settled { get; }

    /// <summary>Each peer's state at the last sample, the host first.</summary>
    IReadOnlyList<ulong> StateHashes { get; }

    /// <summary>Each peer's hash of all events up to then.</summary>
    IReadOnlyList<ulong> EventHashes { get; }

    /// <summary>The largest error of a shared clock.</summary>
    double ClockErrorMilliseconds { get; }

    /// <summary>How many events the host's world went through.</summary>
    long Events { get; }

    /// <summary>How often peers rewrote their past for another's event that came late; 0 with a strategy that rewrites none.</summary>
    long Heals { get; }

    /// <summary>Each peer's datagrams, UDP and IP headers included; what a carrier adds of its own is not.</summary>
    IReadOnlyList<double> BytesSentPerSecond { get; }

    /// <summary>By how many milliseconds other peers' events came after their stamp.</summary>
    Percentiles Lateness { get; }
}
