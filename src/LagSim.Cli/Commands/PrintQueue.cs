using System;
using System.Collections.Concurrent;
using System.Threading;

namespace LagSim.Cli.Commands;

/// <summary>A queue of output from other threads. The printing thread drains it, and is woken by it.</summary>
internal sealed class PrintQueue : IDisposable
{
    private readonly AutoResetEvent wakeUp = new(false);
    private readonly ConcurrentQueue<Action> told = new();

    /// <summary>Waits for work, at most <paramref name="span"/>.</summary>
    internal void Wait(TimeSpan span) => wakeUp.WaitOne(span);

    /// <summary>Wakes the printing thread. Safe on any thread, at any time.</summary>
    internal void Wake()
    {
        try
        {
            wakeUp.Set();
        }
        catch (ObjectDisposedException)
        {
            // The printing thread has ended.
        }
    }

    /// <summary>Queues output and wakes the printing thread.</summary>
    internal void Tell(Action what)
    {
        Add(what);
        Wake();
    }

    /// <summary>Queues output without waking the printing thread. Order is kept.</summary>
    internal void Add(Action what) => told.Enqueue(what);

    /// <summary>Runs everything queued. For the printing thread.</summary>
    internal void Print()
    {
        while (told.TryDequeue(out Action? what))
        {
            what();
        }
    }

    public void Dispose() => wakeUp.Dispose();
}
