using System;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Core;

/// <summary>Where a session stands, and why it does not run: what it waits for, or why it ended or was interrupted.</summary>
/// <remarks>Changed on the session's thread; read from any thread, except <see cref="RejoiningBecause"/>.</remarks>
internal sealed class SessionStatus
{
    private volatile SessionState state;
    private volatile string? endReason;
    private volatile string waitsFor = "The session has not begun: its thread was not started, or has not done a step yet.";
    private volatile SessionEnd endedBy;
    private volatile RefusalReason refusedFor; // 0 for none
    private volatile Exception? failure;

    internal SessionStatus(SessionState first) => state = first;

    /// <summary>Raised once, on the thread that ended the session.</summary>
    internal event Action? Ended;

    /// <summary>Raised with each new state, on the thread that changed it.</summary>
    internal event Action<SessionState>? Changed;

    internal SessionState State
    {
        get => state;
        set
        {
            if (state != value)
            {
                state = value;
                Changed?.Invoke(value);
            }
        }
    }

    internal bool HasEnded => state == SessionState.Ended;

    internal bool IsRejoining => state == SessionState.Rejoining;

    /// <summary>Why the session ended, as a sentence; null while it goes on.</summary>
    internal string? EndReason => endReason;

    internal SessionEnd EndedBy => endedBy;

    /// <summary>What a session that does not run and has not ended waits for, as a sentence.</summary>
    internal string WaitsFor
    {
        set => waitsFor = value;
    }

    /// <summary>Why the session does not run, as a sentence: what it waits for, or why it ended; null while it runs.</summary>
    internal string? WhyNotRunning => state switch
    {
        SessionState.Running => null,
        SessionState.Ended => endReason,
        _ => waitsFor,
    };

    /// <summary>What the host's refusal says that ended it; null if none did, or it was for another version of the protocol.</summary>
    internal RefusalReason? RefusedFor => refusedFor == 0 ? null : refusedFor;

    /// <summary>The exception that ended it; null if none did.</summary>
    internal Exception? Failure => failure;

    /// <summary>Why this peer asks to be let in again, or did the last time.</summary>
    internal string RejoiningBecause { get; private set; } = "";

    /// <summary>Records that this peer asks to be let in again.</summary>
    internal void Rejoin(string why)
    {
        RejoiningBecause = why;
        State = SessionState.Rejoining;
    }

    /// <summary>Records that the world has begun.</summary>
    internal void BeginRunning()
    {
        if (state is not (SessionState.Ended or SessionState.Rejoining))
        {
            State = SessionState.Running;
        }
    }

    /// <summary>Ends the session because the host refuses to let this peer in, as <see cref="End"/> does.</summary>
    /// <param name="reason">What its refusal says; null if it has no reason.</param>
    /// <param name="why">The same, as a sentence.</param>
    internal void Refuse(RefusalReason? reason, string why)
    {
        if (!HasEnded)
        {
            refusedFor = reason ?? 0;
            End(SessionEnd.Refused, why);
        }
    }

    /// <summary>Ends the session, once; later calls do nothing.</summary>
    /// <param name="by">What ended it.</param>
    /// <param name="reason">Why, as a sentence.</param>
    /// <param name="cause">The exception that ended it, if one did.</param>
    internal void End(SessionEnd by, string reason, Exception? cause = null)
    {
        if (HasEnded)
        {
            return;
        }

        endedBy = by;
        failure = cause;
        endReason = reason; // set first, so that a reader that sees the end sees the reason
        State = SessionState.Ended;
        Ended?.Invoke();
    }
}
