using System.Collections.Generic;
using System.Linq;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>What came of one session with stalls.</summary>
public sealed record StallOutcome
{
    /// <summary>What was drawn.</summary>
    public required StallCase Case { get; init; }

    /// <summary>How many committed states of clients were held against the host's.</summary>
    public long Compared { get; init; }

    /// <summary>How many of them were not the host's.</summary>
    public long Differed { get; init; }

    /// <summary>
    /// How many accepted events the log of a client was to have, from each copy that it got up to where it came, over all clients.
    /// </summary>
    public long Expected { get; init; }

    /// <summary>How many of those it did not have, whether a later copy made up for them or not.</summary>
    public long Lost { get; init; }

    /// <summary>Accepted events in the logs of all hosts there were.</summary>
    public long Accepted { get; init; }

    /// <summary>Events in those logs that the host refused.</summary>
    public long Refused { get; init; }

    /// <summary>
    /// Those of them that came too late: over a link that takes longer than the host's history, that is nearly all of them.
    /// </summary>
    public long RefusedTooLate { get; init; }

    /// <summary>How often a client got a fresh copy of the world.</summary>
    public long Copies { get; init; }

    /// <summary>How often a host that had fallen silent was heard again before anything was lost.</summary>
    public long Regained { get; init; }

    /// <summary>For each stall and client that it touches, how long after its end that client was up to date again, in seconds.</summary>
    public IReadOnlyList<double> RecoverySeconds { get; init; } = [];

    /// <summary>What is not as it should be, as sentences.</summary>
    public IReadOnlyList<string> Failures { get; init; } = [];

    /// <summary>The longest of the recoveries; 0 without any.</summary>
    public double WorstSeconds => RecoverySeconds.DefaultIfEmpty(0).Max();

    /// <summary>Whether all is as it should be.</summary>
    public bool IsGood => Failures.Count == 0 && Compared > 0 && Differed == 0 && Lost == 0;
}
