using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Harness.Verification;

namespace LagSim.Harness.Experiments.Sweep;

/// <summary>
/// A sweep of sessions over links that are full or nearly full. Measures throughput against load, latency, and whether all peers still
/// agree.
/// </summary>
/// <remarks>In virtual time. Each cell is played on one thread from the same seed, so every figure is the same in every run.</remarks>
public static class LinkSweep
{
    /// <summary>Plays all cells, several at a time.</summary>
    /// <param name="options">The cells to play.</param>
    /// <param name="progress">Called with each outcome as it is ready, on any thread but never on two at once; may be null.</param>
    /// <param name="cancellation">Ends it early, with what was done by then.</param>
    /// <returns>One outcome for each cell, in order.</returns>
    public static IReadOnlyList<SweepOutcome> Run(SweepOptions options, Action<SweepOutcome>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        SweepCell[] cells = [.. options.Cells()];
        return ParallelPlay.Run(
            cells.Length, options.Workers, "LagSim sweep", (n, stop) => new SweepRun(cells[n], options, stop).Play(), progress, cancellation);
    }
}
