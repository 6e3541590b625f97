using System;
using System.Collections.Concurrent;

namespace LagSim.Net.Sessions;

/// <summary>What a session's thread was asked and has not answered yet. From any thread, but for <see cref="AnswerAll"/>.</summary>
/// <param name="session">Answers them.</param>
/// <param name="wake">Wakes its thread.</param>
internal sealed class PeerRequests(Session session, Action wake)
{
    private readonly ConcurrentQueue<IPeerRequest> waiting = new();
    private volatile bool isOver;

    /// <summary>Whether nothing is answered any more.</summary>
    internal bool AreOver => isOver;

    /// <summary>Asks, and wakes the session's thread.</summary>
    internal void Add(IPeerRequest request)
    {
        waiting.Enqueue(request);
        wake();
        if (isOver)
        {
            AnswerAll(); // the thread has ended meanwhile, and nobody else will
        }
    }

    /// <summary>Answers all, on the session's thread; or cancels them once that is over.</summary>
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

    /// <summary>The thread has ended: who still waits for an answer, or asks later, gets none.</summary>
    internal void Close()
    {
        isOver = true;
        AnswerAll();
    }
}
