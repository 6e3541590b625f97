using LagSim.Net.Clocks;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>One try of a client to come in, from its first connect request until it has a world: cookie, copy, clock and number.</summary>
/// <remarks>Its steps are the client's; this is what is known so far.</remarks>
internal sealed class JoinAttempt
{
    /// <summary>How long between the first tries to be heard, and between two exchanges while the clock is set.</summary>
    internal static readonly SimDuration Pace = SimDuration.FromMilliseconds(20);

    /// <summary>The longest time between two tries: short, since links lose several datagrams in a row, however far apart.</summary>
    private static readonly SimDuration MostPace = SimDuration.FromMilliseconds(100);

    /// <summary>A cookie that was of no use for so long is stale: another one is asked for.</summary>
    private static readonly SimDuration CookieAge = SimDuration.FromSeconds(20);

    /// <summary>
    /// Each so-many-th try with a cookie is sent without it: a cookie is good for one address, and this peer's may have changed since, which it cannot see.
    /// </summary>
    private const int RequestAfresh = 5;

    private SimDuration pace = Pace;
    private int tries; // with this cookie

    /// <param name="nonce">An answer must bear it.</param>
    /// <param name="now">By the own clock.</param>
    internal JoinAttempt(ulong nonce, SimTime now)
    {
        Nonce = nonce;
        Began = now;
        Due = now;
    }

    internal ulong Nonce { get; }

    /// <summary>When it was begun, by the own clock.</summary>
    internal SimTime Began { get; }

    /// <summary>When to ask again, until there is a welcome.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>When the cookie came.</summary>
    internal SimTime Challenged { get; private set; }

    /// <summary>From the cookie to the welcome: a round trip at least, and more where something was lost.</summary>
    internal SimDuration Took { get; private set; }

    /// <summary>Whether the host has welcomed it.</summary>
    internal bool IsWelcome { get; private set; }

    /// <summary>How many lines of the log are in the copy.</summary>
    internal uint LogStart { get; private set; }

    /// <summary>What the copy's hash is to be.</summary>
    internal ulong CopyHash { get; private set; }

    /// <summary>The fetching of the copy; null before and after it.</summary>
    internal SnapshotDownload? Download { get; set; }

    /// <summary>The copy, once it is here.</summary>
    internal WorldCopy? Copy { get; set; }

    /// <summary>How far the host's clock is.</summary>
    internal ClockSync Clock { get; } = new();

    /// <summary>The number that the host gave, and what comes with it; null before it did.</summary>
    internal SeatDatagram? Seat { get; set; }

    private Token128? Cookie { get; set; }

    /// <summary>Whether copy and clock are here: a number is all that is missing, or not even that.</summary>
    internal bool IsReady => Copy is not null && Clock.IsReady;

    /// <summary>The cookie, if there is one that may still be good; null where another is to be asked for. The next try is later, twice as long each time.</summary>
    internal Token128? Ask(SimTime now)
    {
        Due = now + pace;
        pace = pace * 2 < MostPace ? pace * 2 : MostPace;
        return Cookie is Token128 cookie && now - Challenged <= CookieAge && ++tries % RequestAfresh != 0 ? cookie : null;
    }

    /// <summary>Takes a cookie; false for one that it has.</summary>
    internal bool Take(Token128 cookie, SimTime now)
    {
        if (Cookie == cookie && now - Challenged <= CookieAge)
        {
            return false;
        }

        Cookie = cookie;
        Challenged = now;
        tries = 0;
        Due = now;
        pace = Pace;
        return true;
    }

    internal void Take(in WelcomeDatagram welcome, SimTime now)
    {
        IsWelcome = true;
        Took = now - Challenged;
        LogStart = welcome.LogIndex;
        CopyHash = welcome.CopyHash;
        Download = new SnapshotDownload(welcome.CopyLength, now);
    }
}
