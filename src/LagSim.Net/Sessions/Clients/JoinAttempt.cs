using System;
using LagSim.Net.Clocks;
using LagSim.Net.Protection;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// One attempt of a client to join, from its first connect request until it has a world: cookie, snapshot, clock and number.
/// </summary>
/// <remarks>It holds what is known so far; the client drives the steps.</remarks>
internal sealed class JoinAttempt : IDisposable
{
    /// <summary>The interval between the first tries, and between exchanges while the clock is being set.</summary>
    internal static readonly SimDuration Pace = SimDuration.FromMilliseconds(20);

    /// <summary>The longest interval between tries. It is short, since links lose several datagrams in a row, however far apart.</summary>
    private static readonly SimDuration MaxPace = SimDuration.FromMilliseconds(100);

    /// <summary>The age at which an unsuccessful cookie is stale, and another is requested.</summary>
    private static readonly SimDuration CookieAge = SimDuration.FromSeconds(20);

    /// <summary>
    /// How often a try is sent without the cookie: every fifth time. A cookie is good for one address, and this peer's may have changed
    /// unnoticed.
    /// </summary>
    private const int RequestAfresh = 5;

    private SimDuration pace = Pace;
    private int tries; // with this cookie
    private byte[] join = [];

    /// <param name="nonce">An answer must carry it.</param>
    /// <param name="now">The time by the local clock.</param>
    internal JoinAttempt(ulong nonce, SimTime now)
    {
        Nonce = nonce;
        Began = now;
        Due = now;
    }

    internal ulong Nonce { get; }

    /// <summary>When it began, by the local clock.</summary>
    internal SimTime Began { get; }

    /// <summary>When to ask again, until there is a welcome.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>When the cookie arrived.</summary>
    internal SimTime Challenged { get; private set; }

    /// <summary>The time from the cookie to the welcome: a round trip at least, and more if something was lost.</summary>
    internal SimDuration Took { get; private set; }

    /// <summary>Whether the host has welcomed it.</summary>
    internal bool IsWelcome { get; private set; }

    /// <summary>The number of log entries that the snapshot includes.</summary>
    internal uint LogStart { get; private set; }

    /// <summary>The expected hash of the snapshot.</summary>
    internal ulong CopyHash { get; private set; }

    /// <summary>The download in progress; null before and after it.</summary>
    internal SnapshotDownload? Download { get; set; }

    /// <summary>The snapshot, once it is here.</summary>
    internal SessionSnapshot? Snapshot { get; set; }

    /// <summary>The estimate of the host's clock.</summary>
    internal ClockSync Clock { get; } = new();

    /// <summary>The number that the host gave, and what comes with it; null before that.</summary>
    internal SeatDatagram? Seat { get; set; }

    /// <summary>The handshake that the join with this cookie began; null before that, and in a session without protection.</summary>
    internal IClientHandshake? Handshake { get; private set; }

    /// <summary>The join with this cookie, to be sent unchanged until it is answered; empty before there is one.</summary>
    internal ReadOnlySpan<byte> Join => join;

    private Token128? Cookie { get; set; }

    /// <summary>Whether snapshot and clock are ready, so that at most the number is missing.</summary>
    internal bool IsReady => Snapshot is not null && Clock.IsReady;

    /// <summary>
    /// Whether to send the join, whose cookie may still be good; otherwise another cookie is needed. Schedules the next try; the interval
    /// doubles each time, up to <see cref="MaxPace"/>.
    /// </summary>
    internal bool AsksToJoin(SimTime now)
    {
        Due = now + pace;
        pace = pace * 2 < MaxPace ? pace * 2 : MaxPace;
        return Cookie is not null && now - Challenged <= CookieAge && ++tries % RequestAfresh != 0;
    }

    /// <summary>Whether it has that cookie already, and may still use it.</summary>
    internal bool Has(Token128 cookie, SimTime now) => Cookie == cookie && now - Challenged <= CookieAge;

    /// <summary>Takes another cookie, and the join with it.</summary>
    internal void Take(Token128 cookie, byte[] joinWithIt, IClientHandshake? handshake, SimTime now)
    {
        Handshake?.Dispose();
        Handshake = handshake;
        join = joinWithIt;
        Cookie = cookie;
        Challenged = now;
        tries = 0;
        Due = now;
        pace = Pace;
    }

    /// <summary>Wipes the keys of the handshake, if it was not finished.</summary>
    public void Dispose() => Handshake?.Dispose();

    internal void Take(in WelcomeDatagram welcome, SimTime now)
    {
        IsWelcome = true;
        Handshake?.Dispose();
        Took = now - Challenged;
        LogStart = welcome.LogIndex;
        CopyHash = welcome.CopyHash;
        Download = new SnapshotDownload(welcome.CopyLength, now);
    }
}
