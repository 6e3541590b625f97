using System;
using System.Diagnostics;
using LagSim.Events;
using LagSim.Net.Sessions.Core;

namespace LagSim.Net.Sessions;

/// <summary>Reports failures on a session's thread that end nothing: handlers that throw, and actions that are refused.</summary>
/// <remarks>Without a handler they are written to <see cref="Trace"/>, so none is lost.</remarks>
internal sealed class PeerFailures(SessionOwner owner)
{
    internal event Action<Exception>? HandlerFailed;

    internal HandlerList<Action<PlayerAction, Exception>> Refused { get; } = new(owner);

    internal void TellRefused(PlayerAction action, Exception why)
    {
        if (Refused.IsEmpty)
        {
            Trace.TraceWarning($"{action.Kind} was refused, and nobody listens to {nameof(PeerThread.Refused)}: {why.Message}");
        }

        Refused.Raise((Action: action, Why: why), static (handler, told) => handler(told.Action, told.Why));
    }

    /// <summary>Notifies all handlers, even if one of them throws.</summary>
    internal void TellFailure(Exception failure)
    {
        Delegate[] handlers = HandlerFailed?.GetInvocationList() ?? Array.Empty<Delegate>();
        if (handlers.Length == 0)
        {
            Trace.TraceError($"A handler of a session threw, and nobody listens to {nameof(PeerThread.HandlerFailed)}: {failure}");
        }

        foreach (Delegate handler in handlers)
        {
            try
            {
                ((Action<Exception>)handler)(failure);
            }
            catch (Exception other) when (other is not OutOfMemoryException)
            {
                Trace.TraceError($"A handler of {nameof(PeerThread.HandlerFailed)} threw: {other}");
            }
        }
    }
}
