using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>How a peer handles an accepted event of another peer, which usually arrives late.</summary>
/// <remarks>One instance serves one session, on its thread. The same code runs in real and in virtual time.</remarks>
internal interface ILateEventStrategy
{
    /// <summary>The strategy's name on the command line and in reports.</summary>
    string Name { get; }

    /// <summary>Whether all peers that use it end up with the same world, bit for bit.</summary>
    bool PromisesAgreement { get; }

    /// <summary>Whether a late event takes effect at its own time, so that the past since then is rewritten.</summary>
    bool RewritesPast { get; }

    /// <summary>
    /// How the world rewrites what an event before its time has changed. That includes own events, which fall into what is already
    /// simulated ahead.
    /// </summary>
    HealingMode Mode { get; }

    /// <summary>
    /// How far behind shared time the world is shown, at least zero. Events that arrive within that time are applied before they are drawn;
    /// zero shows the present.
    /// </summary>
    /// <remarks>
    /// Own actions show that much later too. A frame reads at <see cref="Sessions.Session.DisplayTime"/>, which includes the delay.
    /// </remarks>
    SimDuration DisplayDelay { get; }

    /// <summary>Applies the event to the world.</summary>
    /// <param name="world">The world, simulated to beyond <paramref name="arrival"/> unless it is behind.</param>
    /// <param name="external">The event as its sender stamped it.</param>
    /// <param name="arrival">Shared time now; may be before the event's own time.</param>
    /// <returns>The result of submitting it.</returns>
    SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival);
}
