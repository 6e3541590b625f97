using System;
using System.Collections.Concurrent;

namespace LagSim.Net.Sessions;

/// <summary>The unanswered requests to a session's thread. From any thread, except <see cref="AnswerAll"/>.</summary>
/// <param name="session">The session that answers them.</param>
/// <param name="wake">Wakes the session's thread.</param>
internal sealed class PeerRequests(Session session, Action wake)
{
    private readonly ConcurrentQueue<IPeerRequest> waiting = new();
    private volatile bool isOver;

    /// <summary>Whether requests are no longer answered.</summary>
    internal bool AreOver => isOver;

    /// <summary>Adds a request and wakes the session's thread.</summary>
    internal void Add(IPeerRequest request)
    {
        waiting.Enqueue(request);
        wake();
        if (isOver)
        {
            AnswerAll(); // the thread has ended meanwhile
        }
    }

    /// <summary>Answers all requests, on the session's thread; cancels them once that has ended.</summary>
    internal void AnswerAll()
    {
        while (waiting.TryDequeue(out IPeerRequest? request))
        {
            if (isOver)
            {
                request.Cancel();
            }
            else
            {
                request.Answer(session);
            }
        }
    }

    /// <summary>Called when the thread has ended: pending and later requests are cancelled.</summary>
    internal void Close()
    {
        isOver = true;
        AnswerAll();
    }
}
