using System;
using LagSim.Events;
using LagSim.Net.Sessions.Core;

namespace LagSim.Net.Sessions;

/// <summary>Tells the handlers of <see cref="PeerThread.Refused"/> which actions were refused, and why.</summary>
/// <param name="owner">The session's thread.</param>
internal sealed class ActionRefusals(SessionOwner owner)
{
    private readonly HandlerList<Action<PlayerAction, Exception>> handlers = new(owner);

    /// <summary>Adds a handler. From any thread.</summary>
    internal void Add(Action<PlayerAction, Exception>? handler) => handlers.Add(handler);

    /// <summary>Removes one. From any thread.</summary>
    internal void Remove(Action<PlayerAction, Exception>? handler) => handlers.Remove(handler);

    /// <summary>Tells all handlers, or the trace where there is none. On the session's thread.</summary>
    internal void Tell(PlayerAction action, Exception why)
    {
        if (handlers.IsEmpty)
        {
            HandlerFailures.Write(
                $"{action.Kind} was refused, and nothing listens to {nameof(PeerThread)}.{nameof(PeerThread.Refused)}: {why.Message}");
        }

        handlers.Raise((Action: action, Why: why), static (handler, told) => handler(told.Action, told.Why));
    }
}
