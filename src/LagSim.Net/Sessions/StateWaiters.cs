using System;
using System.Collections.Generic;
using System.Threading;
using System.Threading.Tasks;
using LagSim.Net.Sessions.Core;

namespace LagSim.Net.Sessions;

/// <summary>Those who wait for a session to get into a state, on any thread. What follows their wait never runs on the session's.</summary>
internal sealed class StateWaiters
{
    private readonly List<Waiter> waiting = new(); // also the lock
    private readonly SessionStatus status;
    private Exception? over; // why nothing can come any more; null while the session's thread may still run

    internal StateWaiters(SessionStatus status)
    {
        this.status = status;
        status.Changed += Note;
    }

    /// <summary>A task that completes in that state; see <see cref="PeerThread.WhenState"/>.</summary>
    internal Task When(SessionState wanted, TimeSpan timeout, CancellationToken cancellation)
    {
        if (timeout != Timeout.InfiniteTimeSpan && (timeout < TimeSpan.Zero || timeout.TotalMilliseconds > int.MaxValue))
        {
            throw new ArgumentOutOfRangeException(
                nameof(timeout), timeout, "It waits for zero to 24 days, or for Timeout.InfiniteTimeSpan.");
        }

        Waiter waiter = Add(wanted);
        if (!waiter.Task.IsCompleted)
        {
            waiter.GiveUpAfter(timeout, () => Drop(waiter) ? status.WhyNotRunning : null, cancellation);
        }

        return waiter.Task;
    }

    /// <summary>Blocks until the session is in that state, or cannot get there any more, or the time is over.</summary>
    internal void Wait(SessionState wanted, TimeSpan timeout)
    {
        Waiter waiter = Add(wanted);
        try
        {
            Task.WaitAny(new[] { waiter.Task }, timeout);
        }
        finally
        {
            Drop(waiter);
        }
    }

    /// <summary>Ends all waiting: the session's thread is over.</summary>
    /// <param name="fault">The exception that ended it; null for none.</param>
    internal void Close(Exception? fault)
    {
        lock (waiting)
        {
            over ??= new InvalidOperationException(
                fault is null ? "The session's thread was stopped." : $"The session's thread ended: {fault.Message}", fault);
            Complete(static _ => false);
        }
    }

    private void Note(SessionState state)
    {
        lock (waiting)
        {
            Complete(waiter => waiter.Wanted == state);
        }
    }

    /// <summary>Completes those whose state it is, and those whose state cannot come any more.</summary>
    private void Complete(Predicate<Waiter> isThere)
    {
        for (int n = waiting.Count - 1; n >= 0; n--)
        {
            Waiter waiter = waiting[n];
            if (isThere(waiter) ? waiter.Succeed() : Never() is Exception never && waiter.Fail(never))
            {
                waiting.RemoveAt(n);
            }
        }
    }

    /// <summary>Why a state that the session is not in cannot come any more; null if it can.</summary>
    private Exception? Never() =>
        status.HasEnded ? new InvalidOperationException(status.EndReason, status.Failure) : over;

    private Waiter Add(SessionState wanted)
    {
        Waiter waiter = new(wanted);
        lock (waiting)
        {
            if (status.State == wanted)
            {
                waiter.Succeed();
            }
            else if (Never() is Exception never)
            {
                waiter.Fail(never);
            }
            else
            {
                waiting.Add(waiter);
            }
        }

        return waiter;
    }

    private bool Drop(Waiter waiter)
    {
        lock (waiting)
        {
            return waiting.Remove(waiter);
        }
    }

    /// <summary>One that waits. Its continuations run on other threads than the one that completes it.</summary>
    private sealed class Waiter(SessionState wanted)
    {
        private readonly TaskCompletionSource<bool> source = new(TaskCreationOptions.RunContinuationsAsynchronously);

        internal SessionState Wanted { get; } = wanted;

        internal Task Task => source.Task;

        internal bool Succeed() => source.TrySetResult(true) || true;

        internal bool Fail(Exception why)
        {
            source.TrySetException(why);
            _ = source.Task.Exception; // seen: one who only blocks does not look at it
            return true;
        }

        /// <summary>Fails once the time is over, and is cancelled by the token, unless it was completed by then.</summary>
        /// <param name="timeout">The time.</param>
        /// <param name="giveUp">Takes it off the list, and says why it is not there; null if it was completed.</param>
        /// <param name="cancellation">Cancels it.</param>
        internal void GiveUpAfter(TimeSpan timeout, Func<string?> giveUp, CancellationToken cancellation)
        {
            Timer timer = new(_ =>
            {
                if (giveUp() is string why)
                {
                    Fail(new TimeoutException(why));
                }
            });
            CancellationTokenRegistration watch = cancellation.Register(() =>
            {
                giveUp();
                source.TrySetCanceled(cancellation);
            });
            timer.Change(timeout, Timeout.InfiniteTimeSpan);
            source.Task.ContinueWith(
                _ =>
                {
                    timer.Dispose();
                    watch.Dispose();
                },
                CancellationToken.None,
                TaskContinuationOptions.None,
                TaskScheduler.Default);
        }
    }
}
