using System;
using System.Threading;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>
/// One dedicated thread that does a step, waits until the next is due or something wakes it, and does the next. It never spins.
/// </summary>
/// <remarks>
/// Thread-safe. An exception in a step ends the thread; <see cref="Fault"/> returns it, and <see cref="ThrowIfFaulted"/> throws it to a
/// caller that still relies on the thread.
/// </remarks>
public sealed class WorldThread : IDisposable
{
    private readonly Func<SimDuration> step;
    private readonly Action? interrupt;
    private readonly Action<Exception?>? atEnd;
    private readonly AutoResetEvent wake = new(false);
    private readonly ManualResetEvent over = new(false); // the thread does nothing any more
    private readonly Thread thread;
    private volatile bool isAbandoned;
    private Exception? fault;
    private long steps;
    private volatile bool stopping;
    private int disposed; // 1 once it is

    /// <summary>A thread that is not started yet.</summary>
    /// <param name="name">The name in debuggers and profilers.</param>
    /// <param name="step">Does what is due and returns the time until something is due again; <see cref="SimDuration.MaxValue"/>: until
    /// woken.</param>
    /// <param name="interrupt">
    /// Makes a running step end soon, by an <see cref="OperationCanceledException"/>. Called once, when the thread is disposed, on the
    /// disposing thread. Default: such a step is waited for.
    /// </param>
    /// <param name="atEnd">
    /// Called on the thread after its last step, with the exception that ended it or null; <see cref="Fault"/> is set by then, and
    /// <see cref="Dispose"/> returns after it. What it throws becomes the fault, if there is none. Not called of a thread that was never
    /// started.
    /// </param>
    public WorldThread(string name, Func<SimDuration> step, Action? interrupt = null, Action<Exception?>? atEnd = null)
    {
        this.interrupt = interrupt;
        this.atEnd = atEnd;
        this.step = step ?? throw new ArgumentNullException(nameof(step));
        thread = new Thread(Run) { IsBackground = true, Name = name };
    }

    /// <summary>The exception that ended the thread, or null.</summary>
    public Exception? Fault => Volatile.Read(ref fault);

    /// <summary>How many steps were done.</summary>
    public long Steps => Volatile.Read(ref steps);

    /// <summary>Starts it; once.</summary>
    /// <exception cref="InvalidOperationException">It has been started already.</exception>
    /// <exception cref="ObjectDisposedException">It has been disposed.</exception>
    public void Start()
    {
        if (Volatile.Read(ref disposed) != 0)
        {
            throw new ObjectDisposedException(thread.Name);
        }

        if ((thread.ThreadState & ThreadState.Unstarted) == 0)
        {
            throw new InvalidOperationException($"The thread '{thread.Name}' has been started already.");
        }

        thread.Start();
    }

    /// <summary>Has the next step done now. Never blocks; calling it from a step, or many times, means one more step.</summary>
    public void Wake()
    {
        if (!stopping)
        {
            wake.Set();
        }
    }

    /// <summary>Throws if the thread ended by an exception.</summary>
    /// <exception cref="InvalidOperationException">It did; the inner exception is what a step threw.</exception>
    public void ThrowIfFaulted()
    {
        if (Fault is Exception failure)
        {
            throw new InvalidOperationException($"The thread '{thread.Name}' ended: {failure.Message}", failure);
        }
    }

    /// <summary>Interrupts the current step, or waits for it where nothing can, and ends the thread.</summary>
    /// <remarks>
    /// Safe to call twice, and from several threads: each returns once the thread has ended, or was given up because rules did not return
    /// from a call. Called from the thread itself it returns at once, and the thread ends after this step.
    /// </remarks>
    public void Dispose()
    {
        if (Interlocked.Exchange(ref disposed, 1) == 0)
        {
            stopping = true;
            interrupt?.Invoke();
            wake.Set();
        }

        if (thread.IsAlive && thread != Thread.CurrentThread)
        {
            over.WaitOne();
            if (!isAbandoned)
            {
                thread.Join();
            }
        }

        // The events themselves are left to their finalisers: another thread may be about to set one.
    }

    /// <summary>
    /// Gives a thread up that is in a step that never returns: <see cref="Dispose"/> does not wait for it, and what it was to do at its end
    /// is left to the caller.
    /// </summary>
    /// <param name="why">What becomes the <see cref="Fault"/>; null for none.</param>
    /// <remarks>From any thread. .NET can end no thread, so it is the caller's to know that this one does not come back; see
    /// <see cref="RuleWatchdog.Abandoned"/>.</remarks>
    public void Abandon(Exception? why)
    {
        Volatile.Write(ref fault, why);
        isAbandoned = true;
        stopping = true;
        over.Set();
    }

    private void Run()
    {
        try
        {
            while (!stopping)
            {
                SimDuration left = step();
                Volatile.Write(ref steps, steps + 1); // no other thread writes it
                if (left > SimDuration.Zero && !stopping)
                {
                    wake.WaitOne(Milliseconds(left));
                }
            }
        }
        catch (OperationCanceledException) when (stopping)
        {
            // As asked.
        }
        catch (Exception failure)
        {
            Volatile.Write(ref fault, failure);
        }

        try
        {
            atEnd?.Invoke(Fault);
        }
        catch (Exception failure)
        {
            Volatile.Write(ref fault, Fault ?? failure);
        }

        over.Set();
    }

    // Rounded up: a wait that ends early would only be followed by another.
    private static int Milliseconds(SimDuration wait)
    {
        double milliseconds = Math.Ceiling(wait.ToMilliseconds());
        return milliseconds >= int.MaxValue ? Timeout.Infinite : (int)milliseconds;
    }
}
