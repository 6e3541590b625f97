using System;

namespace LagSim.Testing;

/// <summary>
/// Thrown if a player's world in a test differed from the one that the accepted events produce. The message names player, body, instant and
/// both states.
/// </summary>
public sealed class WorldsDifferException : SessionTestException
{
    /// <summary>Creates an exception without a message; prefer the one with the result.</summary>
    public WorldsDifferException()
    {
    }

    /// <summary>Creates an exception with a sentence that says what differs.</summary>
    public WorldsDifferException(string message)
        : base(message)
    {
    }

    /// <summary>Creates an exception with a sentence and its cause.</summary>
    public WorldsDifferException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    internal WorldsDifferException(string message, SessionTestResult result)
        : base(message) => Result = result;

    /// <summary>The whole result of the run; null if the exception was made without one.</summary>
    public SessionTestResult? Result { get; }
}
