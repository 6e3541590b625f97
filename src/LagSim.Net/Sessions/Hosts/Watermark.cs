using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The time before which a host accepts no event any more: the history before the clock, or before where the world stands if that is
/// behind. With promises it is later: as far as all who play have promised to stamp no more events. It never goes back.
/// </summary>
/// <remarks>
/// <para>While a host is stuck, what it has not simulated can still be changed, above all by removing what it is stuck on.</para>
/// <para>No honest client loses an event by promises: a client that came in stamps nothing before the watermark that it is told with its
/// number, and while its first promise is on its way the watermark goes on by the history alone. What it promises counts once all events
/// before the promise are here and were judged.</para>
/// </remarks>
/// <param name="sharedTime">The session's time.</param>
/// <param name="world">The world.</param>
/// <param name="history">How late an event may be at the most.</param>
/// <param name="players">Who makes promises; null if they do not count.</param>
internal sealed class Watermark(SharedClock sharedTime, SharedWorld world, SimDuration history, ClientRoster? players = null)
{
    /// <summary>
    /// The longest pause between two promises of a client, where they count. Shorter, and things are final sooner; each is a datagram.
    /// </summary>
    internal static readonly SimDuration Pace = SimDuration.FromMilliseconds(50);

    private SimTime newest = SimTime.MinValue;
    private int holds;

    /// <summary>Whether promises count.</summary>
    internal bool CountsPromises => players is not null;

    /// <summary>The watermark now.</summary>
    internal SimTime Now
    {
        get
        {
            if (holds > 0)
            {
                return newest;
            }

            SimTime now = sharedTime.Now;
            SimTime simulated = world.Live is null ? now : SimTime.Min(now, world.Live.Simulation.SimulatedTo);
            newest = SimTime.Max(newest, simulated - history);
            if (players is not null && world.Live is { IsBehind: false })
            {
                newest = SimTime.Max(newest, SimTime.Min(simulated, players.Promised));
            }

            return newest;
        }
    }

    /// <summary>Keeps it where it is until <see cref="Resume"/>, while events with several stamps are done in no order of time.</summary>
    internal void Hold() => holds++;

    /// <summary>Lets it go on.</summary>
    internal void Resume() => holds--;
}
