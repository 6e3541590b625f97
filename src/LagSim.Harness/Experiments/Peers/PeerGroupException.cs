using System;

namespace LagSim.Harness.Experiments.Peers;

/// <summary>The peers of a test did not connect, or one of them ended early. The message says which and why.</summary>
public sealed class PeerGroupException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public PeerGroupException()
    {
    }

    /// <summary>A sentence that says which peer and why.</summary>
    public PeerGroupException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public PeerGroupException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
