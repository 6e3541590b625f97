using System;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>A recorded hand motion cannot be read. The message names the file, the line, the value and what is allowed.</summary>
public sealed class HandMotionException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public HandMotionException()
    {
    }

    /// <summary>A sentence.</summary>
    public HandMotionException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public HandMotionException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
