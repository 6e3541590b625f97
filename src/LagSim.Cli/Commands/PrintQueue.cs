using System;
using System.Collections.Concurrent;
using System.Threading;

namespace LagSim.Cli.Commands;

/// <summary>What other threads have to say of a session, kept for the one that prints, which it wakes.</summary>
internal sealed class PrintQueue : IDisposable
{
    private readonly AutoResetEvent wakeUp = new(false);
    private readonly ConcurrentQueue<Action> told = new();

    /// <summary>Waits until there is something to do, but no longer than that.</summary>
    internal void Wait(TimeSpan span) => wakeUp.WaitOne(span);

    /// <summary>Has the printing thread look around; from any thread, at any time.</summary>
    internal void Wake()
    {
        try
        {
            wakeUp.Set();
        }
        catch (ObjectDisposedException)
        {
            // Nobody waits any more.
        }
    }

    /// <summary>Has that said at once.</summary>
    internal void Tell(Action what)
    {
        Add(what);
        Wake();
    }

    /// <summary>Has that said after all that was said before, when the printing thread next looks around.</summary>
    internal void Add(Action what) => told.Enqueue(what);

    /// <summary>Says all that waits; for the printing thread.</summary>
    internal void Print()
    {
        while (told.TryDequeue(out Action? what))
        {
            what();
        }
    }

    public void Dispose() => wakeUp.Dispose();
}
