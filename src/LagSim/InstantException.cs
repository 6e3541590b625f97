using System;
using LagSim.Time;

namespace LagSim;

/// <summary>
/// An instant cannot be simulated: the game's rules failed in it. Everything before it stays
/// valid, and a late event may remove the cause. This exception does not leave the simulation.
/// </summary>
internal sealed class InstantException : Exception
{
    internal InstantException(string message, SimTime at, Exception? cause = null)
        : base(message, cause)
    {
        At = at;
    }

    /// <summary>The instant.</summary>
    internal SimTime At { get; }

    /// <summary>That with which it ends the simulation, where nothing can remove the cause any more: the same sentence and cause.</summary>
    internal SimulationException AsEnd() => new(Message, InnerException!);
}
