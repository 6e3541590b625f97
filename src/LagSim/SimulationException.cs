using System;

namespace LagSim;

/// <summary>
/// The simulation cannot continue: a state left the range in which it means something. The message names the body and the value.
/// </summary>
/// <remarks>
/// Deterministic like the world itself: every peer that simulates the same events gets it at the same event, except for a
/// <see cref="TimelinesFullException"/>.
/// </remarks>
public class SimulationException : Exception
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public SimulationException()
    {
    }

    /// <summary>A sentence that names the body and the value.</summary>
    public SimulationException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public SimulationException(string message, Exception innerException)
        : base(message, innerException)
    {
    }
}
