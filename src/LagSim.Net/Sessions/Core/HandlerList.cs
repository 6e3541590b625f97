using System;
using System.Collections.Generic;
using System.Threading;

namespace LagSim.Net.Sessions.Core;

/// <summary>The handlers of one session event. They are called one after the other, and one that throws does not stop the others.</summary>
/// <remarks>
/// Added and removed from any thread; calling them allocates nothing. If the owner does not take exceptions, one propagates to the caller
/// that steps the session, and the remaining handlers are not called.
/// </remarks>
/// <typeparam name="THandler">The event's type.</typeparam>
/// <param name="owner">Takes the exceptions that handlers throw.</param>
internal sealed class HandlerList<THandler>(SessionOwner owner)
    where THandler : Delegate
{
    private THandler[] handlers = Array.Empty<THandler>(); // replaced, never modified

    /// <summary>Whether there are no handlers.</summary>
    internal bool IsEmpty => Volatile.Read(ref handlers).Length == 0;

    internal void Add(THandler? handler)
    {
        if (handler is not null)
        {
            Replace(handler, static (all, one) => [.. all, one]);
        }
    }

    internal void Remove(THandler? handler)
    {
        if (handler is not null)
        {
            Replace(handler, Without);
        }
    }

    /// <summary>Calls all handlers.</summary>
    /// <param name="told">The argument to pass.</param>
    /// <param name="call">How to call one; static, so that nothing is allocated.</param>
    internal void Raise<T>(T told, Action<THandler, T> call)
    {
        foreach (THandler handler in Volatile.Read(ref handlers))
        {
            try
            {
                call(handler, told);
            }
            catch (Exception failure) when (owner.IsTaken && failure is not OutOfMemoryException)
            {
                owner.Failures.Report(failure);
            }
        }
    }

    // Removes the last equal one, as a delegate does.
    private static THandler[] Without(THandler[] all, THandler one)
    {
        int at = Array.LastIndexOf(all, one);
        if (at < 0)
        {
            return all;
        }

        List<THandler> rest = new(all);
        rest.RemoveAt(at);
        return rest.ToArray();
    }

    private void Replace(THandler handler, Func<THandler[], THandler, THandler[]> change)
    {
        THandler[] before;
        do
        {
            before = Volatile.Read(ref handlers);
        }
        while (Interlocked.CompareExchange(ref handlers, change(before, handler), before) != before);
    }
}
