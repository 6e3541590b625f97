using System;
using System.Diagnostics;

namespace LagSim.Net.Sessions.Core;

/// <summary>Reports the exceptions that handlers throw on a session's thread; they end nothing.</summary>
/// <remarks>Thread-safe. An exception that nothing listens for is written to <see cref="Trace"/>, so that it is not lost.</remarks>
internal sealed class HandlerFailures
{
    internal event Action<Exception>? Failed;

    /// <summary>Reports an exception to every listener, even if one of them throws. Never throws itself.</summary>
    internal void Report(Exception failure)
    {
        Delegate[] listeners = Failed?.GetInvocationList() ?? Array.Empty<Delegate>();
        if (listeners.Length == 0)
        {
            Write($"A session's handler threw, and nothing listens to {nameof(Session)}.{nameof(Session.HandlerFailed)}: {failure}");
        }

        foreach (Delegate listener in listeners)
        {
            try
            {
                ((Action<Exception>)listener)(failure);
            }
            catch (Exception other) when (other is not OutOfMemoryException)
            {
                Write($"A handler of {nameof(Session)}.{nameof(Session.HandlerFailed)} threw: {other}");
            }
        }
    }

    /// <summary>Does something whose failure is reported.</summary>
    internal void Guard(Action action)
    {
        try
        {
            action();
        }
        catch (Exception failure) when (failure is not OutOfMemoryException)
        {
            Report(failure);
        }
    }

    /// <summary>Says a line to who runs the program, on its standard error.</summary>
    internal static void Say(string line)
    {
        try
        {
            Console.Error.WriteLine(line);
        }
        catch (Exception failure) when (failure is not OutOfMemoryException)
        {
            // It was closed, or the program has put in one of its own that throws.
        }
    }

    /// <summary>Writes a line to <see cref="Trace"/>, whose listeners are anybody's and may throw.</summary>
    internal static void Write(string line)
    {
        try
        {
            Trace.TraceError(line);
        }
        catch (Exception failure) when (failure is not OutOfMemoryException)
        {
            // There is no one left to tell.
        }
    }
}
