using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Linq;
using System.Threading;

namespace LagSim.Harness.Verification;

/// <summary>Plays many drawn things, several at a time, each on one thread, while the caller's thread reports progress.</summary>
internal static class ParallelPlay
{
    private static readonly TimeSpan ProgressEvery = TimeSpan.FromMilliseconds(100);

    /// <summary>Plays all, and tells of each as it is finished.</summary>
    /// <param name="count">How many there are.</param>
    /// <param name="workers">How many at a time.</param>
    /// <param name="name">What the threads are called.</param>
    /// <param name="play">Plays the one of a number, from 0, until a token of its own says stop; safe on several threads.</param>
    /// <param name="finished">Called with each outcome, on any thread but never on two at once; may be null.</param>
    /// <param name="cancellation">Ends it early.</param>
    /// <returns>What the finished ones gave, in order.</returns>
    internal static IReadOnlyList<T> Run<T>(
        int count, int workers, string name, Func<int, CancellationToken, T> play, Action<T>? finished, CancellationToken cancellation)
        where T : class
    {
        object gate = new();
        return Run(count, workers, name, Play, null, cancellation).Finished;

        T Play(int n)
        {
            // One token for all would keep what each has played alive.
            using CancellationTokenSource stop = CancellationTokenSource.CreateLinkedTokenSource(cancellation);
            T outcome = play(n, stop.Token);
            lock (gate)
            {
                finished?.Invoke(outcome);
            }

            return outcome;
        }
    }

    /// <summary>Plays all.</summary>
    /// <param name="count">How many there are.</param>
    /// <param name="workers">How many at a time.</param>
    /// <param name="name">What the threads are called.</param>
    /// <param name="play">Plays the one of a number, from 0; safe on several threads.</param>
    /// <param name="progress">Called from time to time on the caller's thread with the number of finished ones; may be null.</param>
    /// <param name="cancellation">Ends it early.</param>
    /// <returns>What the finished ones gave, in order, and the numbers of those that were given up.</returns>
    internal static (IReadOnlyList<T> Finished, IReadOnlyList<int> Stopped) Run<T>(
        int count, int workers, string name, Func<int, T> play, Action<int>? progress, CancellationToken cancellation)
        where T : class
    {
        T?[] outcomes = new T?[count];
        ConcurrentBag<int> stopped = [];
        int next = -1, done = 0;
        Exception? fault = null;
        Thread[] threads = [.. Enumerable.Range(0, Math.Min(Math.Max(1, workers), count)).Select(n => new Thread(Work) { IsBackground = true, Name = $"{name} {n}" })];
        Array.ForEach(threads, thread => thread.Start());
        foreach (Thread thread in threads)
        {
            while (!thread.Join(ProgressEvery))
            {
                Report();
            }
        }

        return fault is null ? ([.. outcomes.OfType<T>()], [.. stopped.Order()]) : throw fault;

        void Work()
        {
            int n = 0;
            try
            {
                while ((n = Interlocked.Increment(ref next)) < count && !cancellation.IsCancellationRequested)
                {
                    outcomes[n] = play(n);
                    Interlocked.Increment(ref done);
                }
            }
            catch (OperationCanceledException) when (cancellation.IsCancellationRequested)
            {
                stopped.Add(n); // unfinished; the finished ones are reported
            }
            catch (Exception failure)
            {
                Interlocked.CompareExchange(ref fault, failure, null);
                Interlocked.Exchange(ref next, count); // the other threads have no more to do
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
                // The threads end by themselves.
            }
        }
    }
}
