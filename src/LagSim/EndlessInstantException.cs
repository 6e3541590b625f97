using System;
using LagSim.Time;

namespace LagSim;

/// <summary>
/// An instant has more impacts than can be followed; everything before it stays valid. This exception does not leave the simulation.
/// </summary>
internal sealed class EndlessInstantException : Exception
{
    internal EndlessInstantException(string message, SimTime at)
        : base(message)
    {
        At = at;
    }

    /// <summary>The instant.</summary>
    internal SimTime At { get; }
}
