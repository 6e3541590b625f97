using System;
using System.Collections.Generic;
using System.Threading;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>
/// Runs random sessions in which peers stall, are killed and restarted, and change address. Play must continue, or resume by itself.
/// </summary>
/// <remarks>In virtual time. Each session is played on one thread from its seed, so every figure is the same in every run.</remarks>
public static class StallTest
{
    /// <summary>Plays all sessions, several at a time.</summary>
    /// <param name="options">The sessions to play.</param>
    /// <param name="progress">Called with each outcome as it is ready, on any thread but never on two at once; may be null.</param>
    /// <param name="cancellation">Ends it early, with what was done by then.</param>
    /// <returns>One outcome for each session, in the order of seeds.</returns>
    public static IReadOnlyList<StallOutcome> Run(StallOptions options, Action<StallOutcome>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        return ParallelPlay.Run(
            options.Sessions, options.Workers, "LagSim stalls",
            (n, stop) => new StallRun(new StallCase(options.Seed + (ulong)n), options, stop).Play(), progress, cancellation);
    }
}
