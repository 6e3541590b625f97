namespace LagSim.Net.Sessions;

/// <summary>A request to a session's thread, answered between two steps.</summary>
internal interface IPeerRequest
{
    /// <summary>Answers it, on the session's thread. Does not throw.</summary>
    void Answer(Session session);

    /// <summary>Completes it without an answer.</summary>
    void Cancel();
}
