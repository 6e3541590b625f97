using LagSim.Time;

namespace LagSim;

/// <summary>An instant has more impacts than can be followed; what comes before it stands.</summary>
internal sealed class EndlessInstantException : SimulationException
{
    internal EndlessInstantException(string message, SimTime at)
        : base(message)
    {
        At = at;
    }

    /// <summary>The instant.</summary>
    internal SimTime At { get; }
}
