using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;

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
        SweepOutcome?[] outcomes = new SweepOutcome?[cells.Length];
        object gate = new();
        int next = -1;
        Task[] workers = [.. Enumerable.Range(0, Math.Max(1, options.Workers)).Select(_ => Task.Factory.StartNew(Work, TaskCreationOptions.LongRunning))];
        Task.WaitAll(workers);
        return [.. outcomes.OfType<SweepOutcome>()];

        void Work()
        {
            for (int n = Interlocked.Increment(ref next); n < cells.Length && !cancellation.IsCancellationRequested; n = Interlocked.Increment(ref next))
            {
                try
                {
                    // A token linked once for the whole sweep would keep the sessions of all cells alive.
                    using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
                    SweepOutcome outcome = new SweepRun(cells[n], options, stop.Token).Play();
                    outcomes[n] = outcome;
                    lock (gate)
                    {
                        progress?.Invoke(outcome);
                    }
                }
                catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
                {
                    return;
                }
            }
        }
    }
}
