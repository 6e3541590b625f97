using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>Tells a peer that its own machine slept, or its clock jumped: who was not listened to meanwhile was not silent.</summary>
internal sealed class SuspendDetector
{
    private readonly SimDuration longest;
    private SimTime? looked;

    /// <param name="longest">A longer time between two looks is a sleep.</param>
    /// <param name="now">When it first looked, by the own clock; null for the first call of <see cref="Look"/>.</param>
    internal SuspendDetector(SimDuration longest, SimTime? now = null)
    {
        this.longest = longest;
        looked = now;
    }

    /// <summary>How long the machine slept just now; zero if it did not.</summary>
    internal SimDuration Look(SimTime now)
    {
        SimDuration passed = looked is SimTime last ? now - last : SimDuration.Zero;
        looked = now;
        return passed > longest ? passed : SimDuration.Zero;
    }
}
