using System;

namespace LagSim.Testing;

/// <summary>
/// A player of a test had another world than the accepted events make. The message names player, body, instant and both states.
/// </summary>
public sealed class WorldsDifferException : SessionTestException
{
    /// <summary>No message; prefer the one with the result.</summary>
    public WorldsDifferException()
    {
    }

    /// <summary>A sentence that says what differs.</summary>
    public WorldsDifferException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public WorldsDifferException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    internal WorldsDifferException(string message, SessionTestResult result)
        : base(message) => Result = result;

    /// <summary>All that came of the run; null where the exception was made without one.</summary>
    public SessionTestResult? Result { get; }
}
