using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>The result of one session with stalls.</summary>
public sealed record StallOutcome
{
    /// <summary>The session as drawn.</summary>
    public required StallCase Case { get; init; }

    /// <summary>The number of committed states of clients that were compared with the host's.</summary>
    public long Compared { get; init; }

    /// <summary>The number of those that differ from the host's.</summary>
    public long Differed { get; init; }

    /// <summary>
    /// The number of accepted events that clients' logs should have, from each snapshot on to where each log ends, summed over all clients.
    /// </summary>
    public long Expected { get; init; }

    /// <summary>The number of those that are missing, whether or not a later snapshot made up for them.</summary>
    public long Lost { get; init; }

    /// <summary>The number of accepted events in the logs of all hosts.</summary>
    public long Accepted { get; init; }

    /// <summary>The number of refused events in those logs.</summary>
    public long Refused { get; init; }

    /// <summary>
    /// The number of events refused as too late. Over a link with more latency than the host's history, that is nearly all.
    /// </summary>
    public long RefusedTooLate { get; init; }

    /// <summary>The number of fresh snapshots that clients got.</summary>
    public long Copies { get; init; }

    /// <summary>How often a silent host was heard again before anything was lost.</summary>
    public long Regained { get; init; }

    /// <summary>For each stall and each client it affects, the seconds from its end until that client was up to date again.</summary>
    public IReadOnlyList<double> RecoverySeconds { get; init; } = [];

    /// <summary>The failures, as sentences.</summary>
    public IReadOnlyList<string> Failures { get; init; } = [];

    /// <summary>The longest recovery, in seconds; 0 without any.</summary>
    public double WorstSeconds => RecoverySeconds.DefaultIfEmpty(0).Max();

    /// <summary>Whether the session passes.</summary>
    public bool IsGood => Failures.Count == 0 && Compared > 0 && Differed == 0 && Lost == 0;
}
