using LagSim.Net.Clocks;
using LagSim.Net.Sessions.Core;
using LagSim.Time;

namespace LagSim.Net.Sessions.Hosts;

/// <summary>
/// The time before which a host accepts no event any more: the history before the clock, or before where the world stands if that is
/// behind. It waits for players whose events are on their way, as long as the host's options say. With early confirmation it is later: as
/// far as all who play have promised to stamp no more events. It never goes back.
/// </summary>
/// <remarks>
/// <para>While a host is stuck, what it has not simulated can still be changed, above all by removing what it is stuck on.</para>
/// <para>No honest client loses an event by promises: a client that came in stamps nothing before the watermark that it is told with its
/// number, and while its first promise is on its way the watermark goes on by the history alone. What it promises counts once all events
/// before the promise are here and were judged.</para>
/// <para>A player that acts promises several times in a history, so one whose promises stay out has a link that holds its events back: the
/// watermark stays at its newest promise until they come, since whatever it did since is stamped later. One that does nothing makes no
/// promises, which its link would have to carry all the time; what it begins with is a round trip late at most, unless its link is held up just
/// then.</para>
/// </remarks>
/// <param name="sharedTime">The session's time.</param>
/// <param name="world">The world.</param>
/// <param name="options">How late an event may be.</param>
/// <param name="players">Who makes promises; null if nobody does.</param>
internal sealed class Watermark(SharedClock sharedTime, SharedWorld world, HostOptions options, ClientRoster? players = null)
{
    /// <summary>For how long after its newest event a player counts as one that acts, unless all promises count: as long as a silent peer is
    /// waited for by default.</summary>
    internal static readonly SimDuration Acting = SimDuration.FromSeconds(10);

    /// <summary>
    /// The pause between two promises of a client where things are to be final early. Shorter, and they are final sooner; each is a datagram.
    /// </summary>
    private static readonly SimDuration EarlyPace = SimDuration.FromMilliseconds(50);

    /// <summary>The longest pause where they only tell that nothing is on its way: four in the default history, so that three may be lost.</summary>
    private static readonly SimDuration SlowPace = SimDuration.FromMilliseconds(250);

    private readonly SimDuration history = options.Window.History;
    private readonly SimDuration longest = options.LongestHistory;
    private SimTime newest = SimTime.MinValue;
    private int holds;

    /// <summary>The longest pause between two promises of a client; zero if they do not count.</summary>
    internal SimDuration Pace => players is null || (longest == history && !options.ConfirmsEarly) ? SimDuration.Zero
        : options.ConfirmsEarly || history / 4 < EarlyPace ? EarlyPace
        : history / 4 < SlowPace ? history / 4 : SlowPace;

    /// <summary>For how long after its newest event a client keeps that pace; the longest span for always.</summary>
    internal SimDuration PacedFor => options.ConfirmsEarly ? SimDuration.MaxValue : Acting;

    /// <summary>By how much it is behind the clock, or the world, until the next promise comes.</summary>
    internal SimDuration Behind => WaitedFor(Simulated) < Simulated - history ? longest : history;

    /// <summary>The watermark now.</summary>
    internal SimTime Now
    {
        get
        {
            if (holds > 0)
            {
                return newest;
            }

            SimTime simulated = Simulated;
            newest = SimTime.Max(newest, SimTime.Max(simulated - longest, SimTime.Min(simulated - history, WaitedFor(simulated))));
            if (options.ConfirmsEarly && players is not null && world.Live is { IsBehind: false })
            {
                newest = SimTime.Max(newest, SimTime.Min(simulated, players.Promised()));
            }

            return newest;
        }
    }

    private SimTime Simulated
    {
        get
        {
            SimTime now = sharedTime.Now;
            return world.Live is null ? now : SimTime.Min(now, world.Live.Simulation.SimulatedTo);
        }
    }

    /// <summary>Keeps it where it is until <see cref="Resume"/>, while events with several stamps are done in no order of time.</summary>
    internal void Hold() => holds++;

    /// <summary>Lets it go on.</summary>
    internal void Resume() => holds--;

    /// <summary>The time of what may still be on its way; the latest instant if nothing is waited for.</summary>
    private SimTime WaitedFor(SimTime simulated) =>
        players is null || longest == history ? SimTime.MaxValue : players.Expected(simulated, Acting);
}
