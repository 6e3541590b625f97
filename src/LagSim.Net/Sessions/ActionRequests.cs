using System;
using System.Threading.Tasks;
using System.Threading.Tasks.Sources;
using LagSim.Events;

namespace LagSim.Net.Sessions;

/// <summary>A pool of action requests, reused so that asking allocates nothing.</summary>
internal sealed class ActionRequests
{
    /// <summary>The number of requests after which an answer that was not awaited is forgotten.</summary>
    internal const int Kept = 64;

    private readonly object gate = new();
    private readonly ActionRequest[] ring = new ActionRequest[Kept];
    private int next;

    private readonly Action<PlayerAction, Exception> refused;

    /// <param name="refused">Called for each refused action, on the session's thread, before its answer is set.</param>
    internal ActionRequests(Action<PlayerAction, Exception> refused)
    {
        this.refused = refused;
        for (int n = 0; n < Kept; n++)
        {
            ring[n] = new ActionRequest(refused);
        }
    }

    /// <summary>Returns a request to use. One that is still in use is left to its caller and replaced in the pool.</summary>
    internal ActionRequest Take(in PlayerAction action)
    {
        lock (gate)
        {
            int at = next;
            next = (at + 1) % Kept;
            if (!ring[at].TryBegin(action))
            {
                ring[at] = new ActionRequest(refused);
                ring[at].TryBegin(action);
            }

            return ring[at];
        }
    }
}

/// <summary>One action for the session's thread to perform, and its answer.</summary>
/// <param name="refused">Called if it is refused, on the session's thread, before the answer is set.</param>
internal sealed class ActionRequest(Action<PlayerAction, Exception> refused) : IPeerRequest, IValueTaskSource<ExternalEvent>
{
    private readonly object gate = new(); // guards the fields that decide whether it can be reused
    private ManualResetValueTaskSourceCore<ExternalEvent> core = new() { RunContinuationsAsynchronously = true };
    private PlayerAction action;
    private bool isAsked;
    private bool isAwaited;

    /// <summary>The caller's task; valid until the request is reused.</summary>
    internal ValueTask<ExternalEvent> Task
    {
        get
        {
            lock (gate)
            {
                return new ValueTask<ExternalEvent>(this, core.Version);
            }
        }
    }

    /// <summary>Starts over with another action; false while the last one has no answer, or its answer is being awaited.</summary>
    internal bool TryBegin(in PlayerAction next)
    {
        lock (gate)
        {
            if (isAsked || isAwaited)
            {
                return false;
            }

            core.Reset();
            action = next;
            isAsked = true;
            return true;
        }
    }

    public void Answer(Session session)
    {
        try
        {
            core.SetResult(session.Do(action));
        }
        catch (Exception failure)
        {
            try
            {
                refused(action, failure);
            }
            finally
            {
                core.SetException(failure); // the awaiting caller gets it, whatever a handler did
            }
        }
        finally
        {
            Answered();
        }
    }

    public void Cancel()
    {
        core.SetException(new TaskCanceledException());
        Answered();
    }

    public ExternalEvent GetResult(short token)
    {
        lock (gate)
        {
            ExternalEvent done = default;
            try
            {
                done = core.GetResult(token);
            }
            finally
            {
                isAwaited &= token != core.Version;
            }

            return done;
        }
    }

    public ValueTaskSourceStatus GetStatus(short token)
    {
        lock (gate)
        {
            return core.GetStatus(token);
        }
    }

    public void OnCompleted(Action<object?> continuation, object? state, short token, ValueTaskSourceOnCompletedFlags flags)
    {
        lock (gate)
        {
            isAwaited |= token == core.Version;
        }

        core.OnCompleted(continuation, state, token, flags);
    }

    private void Answered()
    {
        lock (gate)
        {
            isAsked = false;
        }
    }
}
