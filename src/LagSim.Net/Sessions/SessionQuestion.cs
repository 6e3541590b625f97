using System;
using System.Threading.Tasks;

namespace LagSim.Net.Sessions;

/// <summary>A question to a session, and its answer.</summary>
/// <param name="question">The question.</param>
internal sealed class SessionQuestion<T>(Func<Session, T> question) : IPeerRequest
{
    private readonly TaskCompletionSource<T> answer = new(TaskCreationOptions.RunContinuationsAsynchronously);

    internal Task<T> Task => answer.Task;

    public void Answer(Session session)
    {
        try
        {
            answer.TrySetResult(question(session));
        }
        catch (Exception failure)
        {
            answer.TrySetException(failure);
        }
    }

    public void Cancel(Exception? fault)
    {
        if (fault is null)
        {
            answer.TrySetCanceled();
        }
        else
        {
            answer.TrySetException(fault);
        }
    }
}
