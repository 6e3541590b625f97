using System;
using System.Threading.Tasks;
using System.Threading.Tasks.Sources;
using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>One action for the session's thread to perform, and its answer.</summary>
/// <param name="refusals">Told if it is refused, on the session's thread, before the answer is set.</param>
/// <param name="failures">Where what an awaiter's context throws goes.</param>
internal sealed class ActionRequest(ActionRefusals refusals, HandlerFailures failures)
    : IPeerRequest, IValueTaskSource<ExternalEvent>
{
    private readonly object gate = new(); // guards the fields that decide whether it can be reused
    private ManualResetValueTaskSourceCore<ExternalEvent> core = new() { RunContinuationsAsynchronously = true };
    private PlayerAction action;
    private SimTime? at;
    private bool isAsked;
    private bool isAwaited;
    private UnheardRefusal? unheard; // of this answer, until somebody asks for it

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
    internal bool TryBegin(in PlayerAction next, SimTime? time)
    {
        lock (gate)
        {
            if (isAsked || isAwaited)
            {
                return false;
            }

            core.Reset();
            action = next;
            at = time;
            isAsked = true;
            unheard = null;
            return true;
        }
    }

    public void Answer(Session session)
    {
        ExternalEvent done;
        try
        {
            done = session.Do(action, at);
        }
        catch (Exception why)
        {
            bool isRefusal = why is InvalidOperationException or ArgumentOutOfRangeException or SceneException or SimulationException; // those that Do documents
            try
            {
                if (isRefusal)
                {
                    Note(refusals.Tell(action, why));
                }
            }
            finally
            {
                Complete(default, why); // the awaiting caller gets it, whatever a handler did
            }

            if (!isRefusal)
            {
                throw; // a fault of the program ends the thread here, as it does in a step
            }

            return;
        }

        Complete(done, null);
    }

    public void Cancel(Exception? fault) => Complete(default, fault ?? new TaskCanceledException());

    public ExternalEvent GetResult(short token)
    {
        lock (gate)
        {
            Hear(token);
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
            Hear(token);
            return core.GetStatus(token);
        }
    }

    public void OnCompleted(Action<object?> continuation, object? state, short token, ValueTaskSourceOnCompletedFlags flags)
    {
        lock (gate)
        {
            isAwaited |= token == core.Version;
            Hear(token);
        }

        core.OnCompleted(continuation, state, token, flags);
    }

    private void Note(UnheardRefusal? refusal)
    {
        lock (gate)
        {
            unheard = refusal;
            if (isAwaited)
            {
                Hear(core.Version);
            }
        }
    }

    // Somebody asks for the answer; within the gate.
    private void Hear(short token)
    {
        if (token == core.Version)
        {
            unheard?.Hear();
        }
    }

    // Completing posts to the awaiter's synchronization context, which may refuse when its program shuts down.
    private void Complete(in ExternalEvent done, Exception? failure)
    {
        try
        {
            if (failure is null)
            {
                core.SetResult(done);
            }
            else
            {
                core.SetException(failure);
            }
        }
        catch (Exception thrown) when (thrown is not OutOfMemoryException)
        {
            failures.Report(thrown);
        }
        finally
        {
            lock (gate)
            {
                isAsked = false;
            }
        }
    }
}
