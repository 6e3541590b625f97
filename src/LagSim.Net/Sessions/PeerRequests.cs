using System;
using System.Collections.Concurrent;
using System.Threading;

namespace LagSim.Net.Sessions;

/// <summary>The unanswered requests to a session's thread. From any thread, except <see cref="AnswerAll"/>.</summary>
/// <param name="session">The session that answers them.</param>
/// <param name="wake">Wakes the session's thread.</param>
internal sealed class PeerRequests(Session session, Action wake)
{
    private readonly ConcurrentQueue<IPeerRequest> waiting = new();
    private volatile IPeerRequest? answering;
    private Exception? fault; // set before isOver is
    private volatile bool isOver;

    /// <summary>Throws if no request is answered any more.</summary>
    /// <exception cref="ObjectDisposedException">The thread was disposed, or cancelled.</exception>
    /// <exception cref="InvalidOperationException">It was given up, or has failed.</exception>
    internal void ThrowIfOver()
    {
        if (isOver)
        {
            throw fault is null ? new ObjectDisposedException(nameof(PeerThread))
                : new InvalidOperationException($"The session's thread is not there any more: {fault.Message}", fault);
        }
    }

    /// <summary>Adds a request and wakes the session's thread. From any thread.</summary>
    internal void Add(IPeerRequest request)
    {
        waiting.Enqueue(request);
        wake();
        Interlocked.MemoryBarrier(); // either this sees that it is over, or Close sees the request
        if (isOver)
        {
            CancelAll();
        }
    }

    /// <summary>
    /// Answers, on the session's thread, the requests that wait now. Those that a handler adds meanwhile wait for the next step, which the
    /// wake-up has come for: else a handler that answers each event with another would keep the session from its next step for ever.
    /// </summary>
    internal void AnswerAll()
    {
        for (int count = waiting.Count; count > 0 && waiting.TryDequeue(out IPeerRequest? request); count--)
        {
            answering = request;
            request.Answer(session);
            answering = null;
        }
    }

    /// <summary>The thread has ended: requests that wait, and those that come later, get no answer.</summary>
    /// <param name="ending">The exception that ended it; null if it was disposed or cancelled.</param>
    internal void Close(Exception? ending)
    {
        fault = ending;
        isOver = true;
        Interlocked.MemoryBarrier();
        CancelAll();
    }

    /// <summary>The thread is given up, and will not come back from what it does: if that answers a request, it is completed, too.</summary>
    /// <param name="why">What ended the session.</param>
    internal void GiveUp(Exception why)
    {
        Close(why);
        answering?.Cancel(why);
    }

    private void CancelAll()
    {
        while (waiting.TryDequeue(out IPeerRequest? request))
        {
            request.Cancel(fault);
        }
    }
}
