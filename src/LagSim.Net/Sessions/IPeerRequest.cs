namespace LagSim.Net.Sessions;

/// <summary>What a session's thread is asked, and answers between two steps.</summary>
internal interface IPeerRequest
{
    /// <summary>Answers it, on the session's thread. Does not throw.</summary>
    void Answer(Session session);

    /// <summary>Answers that there will be no answer.</summary>
    void Cancel();
}
