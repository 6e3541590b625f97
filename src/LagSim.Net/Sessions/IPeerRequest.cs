using System;

namespace LagSim.Net.Sessions;

/// <summary>A request to a session's thread, answered between two steps.</summary>
internal interface IPeerRequest
{
    /// <summary>Answers it, on the session's thread. Throws only what is to end that thread.</summary>
    void Answer(Session session);

    /// <summary>Completes it without an answer: with the exception that ended the thread, or as cancelled if there is none.</summary>
    void Cancel(Exception? fault);
}
