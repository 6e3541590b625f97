using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;

namespace LagSim.Harness.Verification.Harm;

/// <summary>Drawn attacks by one player on everybody's worlds: they go on in real time, or do so again soon, without him.</summary>
/// <remarks>In virtual time. Each attack is played on one thread from its seed, so every figure is the same in every run.</remarks>
public static class HarmTest
{
    /// <summary>Plays all attacks, several at a time.</summary>
    /// <param name="options">Which.</param>
    /// <param name="progress">Called with each outcome as it is there, from any thread but never from two at once; null for nobody.</param>
    /// <param name="cancellation">Ends it early, with what was done by then.</param>
    /// <returns>One outcome an attack, in the order of their seeds.</returns>
    public static IReadOnlyList<HarmOutcome> Run(HarmOptions options, Action<HarmOutcome>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        HarmOutcome?[] outcomes = new HarmOutcome?[options.Attacks];
        object gate = new();
        int next = -1;
        int workers = Math.Max(1, options.Workers);
        Task.WaitAll([.. Enumerable.Range(0, workers).Select(_ => Task.Factory.StartNew(Work, TaskCreationOptions.LongRunning))]);
        return [.. outcomes.OfType<HarmOutcome>()];

        void Work()
        {
            while (!cancellation.IsCancellationRequested && Interlocked.Increment(ref next) is int n && n < outcomes.Length)
            {
                try
                {
                    // The token of all sessions would keep these.
                    using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
                    HarmOutcome outcome = new HarmRun(new HarmCase(options.Seed + (ulong)n), options, stop.Token).Play();
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
