using System;
using System.Threading.Tasks;
using System.Threading.Tasks.Sources;
using LagSim.Events;

namespace LagSim.Net.Sessions;

/// <summary>Requests to do something, made once and used again and again, so that asking allocates nothing.</summary>
internal sealed class ActionRequests
{
    /// <summary>How many requests later an answer that nobody awaits is forgotten.</summary>
    internal const int Kept = 64;

    private readonly object gate = new();
    private readonly ActionRequest[] ring = new ActionRequest[Kept];
    private int next;

    private readonly Action<PlayerAction, Exception> refused;

    /// <param name="refused">Told of each that is refused, on the session's thread, before the answer is there.</param>
    internal ActionRequests(Action<PlayerAction, Exception> refused)
    {
        this.refused = refused;
        for (int n = 0; n < Kept; n++)
        {
            ring[n] = new ActionRequest(refused);
        }
    }

    /// <summary>
    /// A request that is not answered yet. One that is still in use is left to whoever has it, and another takes its place.
    /// </summary>
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

/// <summary>One action that the session's thread is asked to do, and its answer.</summary>
/// <param name="refused">Told if it is refused, on the session's thread, before the answer is there.</param>
internal sealed class ActionRequest(Action<PlayerAction, Exception> refused) : IPeerRequest, IValueTaskSource<ExternalEvent>
{
    private readonly object gate = new(); // of what tells whether it can be used again
    private ManualResetValueTaskSourceCore<ExternalEvent> core = new() { RunContinuationsAsynchronously = true };
    private PlayerAction action;
    private bool isAsked;
    private bool isAwaited;

    /// <summary>What the caller gets; valid until the request is used again.</summary>
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

    /// <summary>Starts anew with another action; false while the last one is not answered, or somebody waits for its answer.</summary>
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
                core.SetException(failure); // whatever a handler did, whoever awaits the answer gets it
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
