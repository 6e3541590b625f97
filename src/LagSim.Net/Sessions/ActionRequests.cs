using LagSim.Events;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>A pool of action requests, reused so that asking allocates nothing.</summary>
internal sealed class ActionRequests
{
    /// <summary>The number of requests after which an answer that was not awaited is forgotten.</summary>
    internal const int Kept = 64;

    private readonly object gate = new();
    private readonly ActionRequest[] ring = new ActionRequest[Kept];
    private readonly ActionRefusals refusals;
    private readonly HandlerFailures failures;
    private int next;

    /// <param name="refusals">Told of each refused action, on the session's thread, before its answer is set.</param>
    /// <param name="failures">Where what an awaiter's context throws goes.</param>
    internal ActionRequests(ActionRefusals refusals, HandlerFailures failures)
    {
        this.refusals = refusals;
        this.failures = failures;
        for (int n = 0; n < Kept; n++)
        {
            ring[n] = new ActionRequest(refusals, failures);
        }
    }

    /// <summary>Returns a request to use. One that is still in use is left to its caller and replaced in the pool.</summary>
    internal ActionRequest Take(in PlayerAction action, SimTime? at)
    {
        lock (gate)
        {
            int place = next;
            next = (place + 1) % Kept;
            if (!ring[place].TryBegin(action, at))
            {
                ring[place] = new ActionRequest(refusals, failures);
                ring[place].TryBegin(action, at);
            }

            return ring[place];
        }
    }
}
