using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>Detects that this machine slept or its clock jumped, so that the other peers are not counted as silent meanwhile.</summary>
internal sealed class SuspendDetector
{
    private readonly SimDuration longest;
    private SimTime? looked;

    /// <param name="longest">A longer time between two calls of <see cref="Look"/> counts as a suspend.</param>
    /// <param name="now">The time of the first look, by the local clock; null for the first call of <see cref="Look"/>.</param>
    internal SuspendDetector(SimDuration longest, SimTime? now = null)
    {
        this.longest = longest;
        looked = now;
    }

    /// <summary>Returns how long the machine slept just now; zero if it did not.</summary>
    internal SimDuration Look(SimTime now)
    {
        SimDuration passed = looked is SimTime last ? now - last : SimDuration.Zero;
        looked = now;
        return passed > longest ? passed : SimDuration.Zero;
    }
}
