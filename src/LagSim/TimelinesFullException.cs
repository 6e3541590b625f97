namespace LagSim;

/// <summary>
/// The timelines need more segments than the options allow, because too much has happened inside the window. The world is right up to then.
/// </summary>
/// <remarks>It is this simulation's own limit, so one with more room, or with less history, continues where this one cannot.</remarks>
public sealed class TimelinesFullException : SimulationException
{
    /// <summary>No message; prefer the one with a sentence.</summary>
    public TimelinesFullException()
    {
    }

    /// <summary>A sentence that names the limit.</summary>
    public TimelinesFullException(string message)
        : base(message)
    {
    }

    /// <summary>A sentence, and what caused it.</summary>
    public TimelinesFullException(string message, System.Exception innerException)
        : base(message, innerException)
    {
    }
}
