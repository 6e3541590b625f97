using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;

namespace LagSim.Harness.Verification.Stalls;

/// <summary>
/// Drawn sessions in which peers stand still, are killed and started again, and change their addresses: play goes on, or resumes by itself.
/// </summary>
/// <remarks>In virtual time. Each session is played on one thread from its seed, so every figure is the same in every run.</remarks>
public static class StallTest
{
    /// <summary>Plays all sessions, several at a time.</summary>
    /// <param name="options">Which.</param>
    /// <param name="progress">Called with each outcome as it is there, from any thread but never from two at once; null for nobody.</param>
    /// <param name="cancellation">Ends it early, with what was done by then.</param>
    /// <returns>One outcome a session, in the order of their seeds.</returns>
    public static IReadOnlyList<StallOutcome> Run(StallOptions options, Action<StallOutcome>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        StallOutcome?[] outcomes = new StallOutcome?[options.Sessions];
        object gate = new();
        int next = -1;
        int workers = Math.Max(1, options.Workers);
        Task.WaitAll([.. Enumerable.Range(0, workers).Select(_ => Task.Factory.StartNew(Work, TaskCreationOptions.LongRunning))]);
        return [.. outcomes.OfType<StallOutcome>()];

        void Work()
        {
            while (!cancellation.IsCancellationRequested && Interlocked.Increment(ref next) is int n && n < outcomes.Length)
            {
                try
                {
                    // The token of all sessions would keep these.
                    using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
                    StallOutcome outcome = new StallRun(new StallCase(options.Seed + (ulong)n), options, stop.Token).Play();
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
