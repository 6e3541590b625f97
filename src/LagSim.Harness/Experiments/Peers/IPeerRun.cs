using System.Collections.Generic;
using LagSim.Harness.Experiments.Metrics;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The measurements that every run of a group of peers has.</summary>
public interface IPeerRun
{
    /// <summary>The errors as seen, at the same shared time.</summary>
    PhaseErrors Seen { get; }

    /// <summary>The errors as seen, at the same true instant.</summary>
    PhaseErrors SeenTrueTime { get; }

    /// <summary>The errors among the timelines once every event has arrived.</summary>
    PhaseErrors Settled { get; }

    /// <summary>Each peer's state at the last sample, the host first.</summary>
    IReadOnlyList<ulong> StateHashes { get; }

    /// <summary>Each peer's hash of all events up to then.</summary>
    IReadOnlyList<ulong> EventHashes { get; }

    /// <summary>The largest error of a shared clock.</summary>
    double ClockErrorMilliseconds { get; }

    /// <summary>The number of events in the host's world.</summary>
    long Events { get; }

    /// <summary>How often peers rewound for another peer's late event; 0 with a strategy that never rewinds.</summary>
    long Heals { get; }

    /// <summary>Bytes per second sent by each peer, UDP and IP headers included, without overhead of other carriers.</summary>
    IReadOnlyList<double> BytesSentPerSecond { get; }

    /// <summary>How late other peers' events arrived, in milliseconds after their stamp.</summary>
    Percentiles Lateness { get; }
}
