using System;

namespace LagSim.Testing;

/// <summary>
/// A session of a test did not come to its end, or a player did what may not be done. The message says who, when and why.
/// </summary>
public class SessionTestException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public SessionTestException()
    {
    }

    /// <summary>A sentence that says what went wrong.</summary>
    public SessionTestException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public SessionTestException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
