using System;
using LagSim.Net.Clocks;
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

    /// <summary>
    /// How often a try is sent without the cookie: every fifth time. A cookie is good for one address, and this peer's may have changed
    /// unnoticed.
    /// </summary>
    private const int RequestAfresh = 5;

    private SimDuration pace = Pace;
    private int tries; // with this cookie

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

    /// <summary>The join with the newest cookie; null before there is one.</summary>
    internal PreparedJoin? Join { get; private set; }

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
        return Join?.IsFresh(now) == true && ++tries % RequestAfresh != 0;
    }

    /// <summary>Whether it has a join with that cookie already, and may still send it.</summary>
    internal bool Has(Token128 cookie, SimTime now) => Join is PreparedJoin join && join.Cookie == cookie && join.IsFresh(now);

    /// <summary>Takes a join with another cookie.</summary>
    internal void Take(PreparedJoin join, SimTime now)
    {
        Join?.Dispose();
        Join = join;
        tries = 0;
        Due = now;
        pace = Pace;
    }

    /// <summary>Wipes the keys of the handshake, if it was not finished.</summary>
    public void Dispose() => Join?.Dispose();

    internal void Take(in WelcomeDatagram welcome, SimTime now)
    {
        IsWelcome = true;
        Join?.Dispose();
        Took = Join is null ? SimDuration.Zero : now - Join.Made;
        LogStart = welcome.LogIndex;
        CopyHash = welcome.CopyHash;
        Download = new SnapshotDownload(welcome.CopyLength, now);
    }
}
