using System;
using System.Diagnostics;
using System.Linq;
using System.Threading;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>
/// The check of single worlds: none ends by what players do, each has the same bits however late its events come, and keeps the promises
/// about its physics.
/// </summary>
/// <remarks>Each world is drawn from its own seed and played on one thread, so every figure except the time taken is the same in every
/// run.</remarks>
public static class WorldCheck
{
    /// <summary>The most failing worlds of which acts are left out.</summary>
    public const int MaxShrunk = 3;

    private static readonly TimeSpan ProgressEvery = TimeSpan.FromMilliseconds(100);

    /// <summary>Plays all worlds, several at a time.</summary>
    /// <param name="options">The options.</param>
    /// <param name="progress">Called from time to time on the caller's thread with the number of finished worlds; may be null.</param>
    /// <param name="cancellation">Ends it early, with a report of the worlds that were done by then.</param>
    public static WorldReport Run(WorldOptions options, Action<int>? progress = null, CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(options);
        ArgumentOutOfRangeException.ThrowIfLessThan(options.Worlds, 1);
        ArgumentOutOfRangeException.ThrowIfLessThan(options.Workers, 1);
        Stopwatch watch = Stopwatch.StartNew();
        WorldOutcome?[] outcomes = new WorldOutcome?[options.Worlds];
        int next = -1, done = 0;
        Exception? fault = null;
        Thread[] workers = [.. Enumerable.Range(0, Math.Min(options.Workers, options.Worlds))
            .Select(n => new Thread(Work) { IsBackground = true, Name = $"LagSim worlds {n}" })];
        Array.ForEach(workers, worker => worker.Start());
        foreach (Thread worker in workers)
        {
            while (!worker.Join(ProgressEvery))
            {
                Report();
            }
        }

        if (fault is not null)
        {
            throw fault;
        }

        return new WorldReport(Shrunk([.. outcomes.OfType<WorldOutcome>()], options, cancellation), options.Worlds,
            watch.Elapsed.TotalSeconds);

        void Work()
        {
            try
            {
                for (int n = Interlocked.Increment(ref next); n < options.Worlds
                    && !cancellation.IsCancellationRequested; n = Interlocked.Increment(ref next))
                {
                    ulong seed = unchecked(options.Seed + (ulong)n);
                    outcomes[n] = WorldPlay.Of(seed, options, cancellation);
                    Interlocked.Increment(ref done);
                }
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                // Unfinished; the finished ones are reported.
            }
            catch (Exception failure)
            {
                Interlocked.CompareExchange(ref fault, failure, null);
                Interlocked.Exchange(ref next, options.Worlds); // the other workers have no more to do
            }
        }

        void Report()
        {
            try
            {
                progress?.Invoke(Volatile.Read(ref done));
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                // The workers end by themselves.
            }
        }
    }

    private static WorldOutcome[] Shrunk(WorldOutcome[] outcomes, WorldOptions options, CancellationToken cancellation)
    {
        int left = options.ShrinkingPlays > 0 ? MaxShrunk : 0;
        for (int n = 0; n < outcomes.Length && left > 0; n++)
        {
            if (outcomes[n].FailureKind == WorldFailureKind.None)
            {
                continue;
            }

            left--;
            try
            {
                outcomes[n] = WorldShrinking.Shrink(outcomes[n], options, cancellation);
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                return outcomes;
            }
        }

        return outcomes;
    }
}
