using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The time before which a host accepts no event any more: the history before the clock, or before where the world stands if that is
/// behind. It never goes back.
/// </summary>
/// <remarks>While a host is stuck, what it has not simulated can still be changed, above all by removing what it is stuck on.</remarks>
internal sealed class Watermark(SharedClock sharedTime, SharedWorld world, SimDuration history)
{
    private SimTime newest = SimTime.MinValue;

    /// <summary>The watermark now.</summary>
    internal SimTime Now
    {
        get
        {
            SimTime now = sharedTime.Now;
            SimTime simulated = world.Live is null ? now : SimTime.Min(now, world.Live.Simulation.SimulatedTo);
            return newest = SimTime.Max(newest, simulated - history);
        }
    }
}
