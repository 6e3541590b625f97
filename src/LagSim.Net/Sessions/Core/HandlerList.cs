using System;
using System.Collections.Generic;
using System.Threading;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// The handlers of one event of a session, called one after the other, so that one that throws keeps no other from its turn.
/// </summary>
/// <remarks>
/// Added and removed from any thread; calling them allocates nothing. Where nobody takes what handlers throw, it goes through to whoever
/// steps the session, and the handlers after it are not called.
/// </remarks>
/// <typeparam name="THandler">The event's type.</typeparam>
/// <param name="owner">Who takes what handlers throw.</param>
internal sealed class HandlerList<THandler>(SessionOwner owner)
    where THandler : Delegate
{
    private THandler[] handlers = Array.Empty<THandler>(); // replaced, never changed

    /// <summary>Whether there is none.</summary>
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

    /// <summary>Calls all.</summary>
    /// <param name="told">What they are told.</param>
    /// <param name="call">How one is called; static, so that nothing is allocated.</param>
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
                owner.TellFailure(failure);
            }
        }
    }

    // As a delegate does: the last that is equal.
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
