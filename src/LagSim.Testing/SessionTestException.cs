using System;

namespace LagSim.Testing;

/// <summary>
/// Thrown if a session of a test did not finish, or a player performed an action that is not allowed. The message says which player, when
/// and why.
/// </summary>
public class SessionTestException : Exception
{
    /// <summary>Creates an exception without a message; prefer the one with a sentence.</summary>
    public SessionTestException()
    {
    }

    /// <summary>Creates an exception with a sentence that says what went wrong.</summary>
    public SessionTestException(string message)
        : base(message)
    {
    }

    /// <summary>Creates an exception with a sentence and its cause.</summary>
    public SessionTestException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
