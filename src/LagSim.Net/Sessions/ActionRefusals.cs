using System;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>Tells which actions were refused, and why: to the handlers of <see cref="PeerThread.Refused"/>, or once to who runs the
/// program.</summary>
/// <param name="owner">The session's thread.</param>
/// <param name="clock">The session's clock.</param>
internal sealed class ActionRefusals(SessionOwner owner, IClock clock)
{
    /// <summary>How long code may take from <see cref="PeerThread.Do"/> to asking for the answer: some instructions, unless its thread is
    /// held up between them.</summary>
    private static readonly SimDuration Patience = SimDuration.FromSeconds(1);

    private readonly HandlerList<Action<PlayerAction, Exception>> handlers = new(owner);
    private UnheardRefusal? unheard; // the one that waits
    private bool hasSaid;

    /// <summary>Adds a handler. From any thread.</summary>
    internal void Add(Action<PlayerAction, Exception>? handler) => handlers.Add(handler);

    /// <summary>Removes one. From any thread.</summary>
    internal void Remove(Action<PlayerAction, Exception>? handler) => handlers.Remove(handler);

    /// <summary>Tells all handlers, or the trace where there is none. On the session's thread.</summary>
    /// <returns>What is to be told who asks for the answer, since otherwise it will be said; null if it will not be.</returns>
    internal UnheardRefusal? Tell(PlayerAction action, Exception why)
    {
        if (handlers.IsEmpty)
        {
            string line = $"{action.Kind} was refused, and nothing listens to {nameof(PeerThread)}.{nameof(PeerThread.Refused)}";
            HandlerFailures.Write($"{line}: {why.Message}");
            if (!hasSaid && unheard is null)
            {
                return unheard = new UnheardRefusal($"{line} or awaits the action: {why.Message} (This is said once.)", clock.Now);
            }
        }

        handlers.Raise((Action: action, Why: why), static (handler, told) => handler(told.Action, told.Why));
        return null;
    }

    /// <summary>Says the first one of which nobody has heard, after a second. On the session's thread.</summary>
    /// <param name="wait">How long the thread has nothing else to do.</param>
    /// <returns>How long it has nothing to do.</returns>
    internal SimDuration SayUnheard(SimDuration wait)
    {
        if (unheard is null)
        {
            return wait;
        }

        SimDuration left = unheard.At + Patience - clock.Now;
        if (left > SimDuration.Zero)
        {
            return left < wait ? left : wait;
        }

        SayUnheard();
        return wait;
    }

    /// <summary>Says it now, since the thread ends.</summary>
    internal void SayUnheard()
    {
        if (unheard is { IsHeard: false })
        {
            hasSaid = true;
            HandlerFailures.Say(unheard.Line);
        }

        unheard = null;
    }
}
