using LagSim.Events;
using LagSim.Hosting;
using LagSim.Time;

namespace LagSim.Net.Strategies;

/// <summary>What a peer does with an accepted event of another peer, which usually comes late.</summary>
/// <remarks>One instance serves one session, on its thread. The same code runs in real and in virtual time.</remarks>
internal interface ILateEventStrategy
{
    /// <summary>What the strategy is called on the command line and in reports.</summary>
    string Name { get; }

    /// <summary>Whether all peers that use it end up with the same world, bit for bit.</summary>
    bool PromisesAgreement { get; }

    /// <summary>Whether a late event takes effect at its own time, so that what was there since is rewritten.</summary>
    bool RewritesPast { get; }

    /// <summary>
    /// How the world rewrites what an event before its time has changed; also one's own events, which lie in what is simulated ahead.
    /// </summary>
    HealingMode Mode { get; }

    /// <summary>
    ///  How far behind shared time the world is shown, at least zero: what has come within that time is there before it is drawn. Zero
    /// shows the present.
    /// </summary>
    /// <remarks>
    /// One's own actions show that much later too. A frame reads at <see cref="Sessions.Session.DisplayTime"/>, which knows.
    /// </remarks>
    SimDuration DisplayDelay { get; }

    /// <summary>Brings the event into the world.</summary>
    /// <param name="world">The world, simulated to beyond <paramref name="arrival"/> unless it is behind.</param>
    /// <param name="external">The event as its sender stamped it.</param>
    /// <param name="arrival">Shared time now; may be before the event's own time.</param>
    /// <returns>What became of it.</returns>
    SubmitResult Apply(LiveWorld world, in ExternalEvent external, SimTime arrival);
}
