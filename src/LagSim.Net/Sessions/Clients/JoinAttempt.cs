using System;
using System.Collections.Generic;
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

    /// <summary>
    /// The most joins kept, each with a cookie of its own: a challenge may be anybody's on the path, so a new one must not undo what
    /// another began. Fewer than <see cref="RequestAfresh"/>, so that each is sent again and again.
    /// </summary>
    private const int MostJoins = 4;

    private readonly List<PreparedJoin> joins = new(); // the oldest first
    private PreparedJoin? unsent;
    private SimDuration pace = Pace;
    private int tries;

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

    /// <summary>The joins that may be answered yet, each with a cookie of its own.</summary>
    internal IReadOnlyList<PreparedJoin> Joins => joins;

    /// <summary>Whether snapshot and clock are ready, so that at most the number is missing.</summary>
    internal bool IsReady => Snapshot is not null && Clock.IsReady;

    /// <summary>
    /// The join to send, whose cookie may still be good; null if another cookie is needed. Schedules the next try; the interval doubles
    /// each time, up to <see cref="MaxPace"/>.
    /// </summary>
    internal PreparedJoin? Next(SimTime now)
    {
        Due = now + pace;
        pace = pace * 2 < MaxPace ? pace * 2 : MaxPace;
        while (joins.Count > 0 && !joins[0].IsFresh(now))
        {
            RemoveOldest();
        }

        if (joins.Count == 0 || ++tries % RequestAfresh == 0)
        {
            return null;
        }

        PreparedJoin join = unsent ?? joins[tries % joins.Count];
        unsent = null;
        return join;
    }

    /// <summary>Whether it has a join with that cookie already, and may still send it.</summary>
    internal bool Has(Token128 cookie, SimTime now) => joins.Exists(join => join.Cookie == cookie && join.IsFresh(now));

    /// <summary>Takes a join with another cookie, to be sent at once.</summary>
    internal void Take(PreparedJoin join, SimTime now)
    {
        int most = join.Handshake is null ? 1 : MostJoins; // without protection anybody's answer counts in any case
        while (joins.Count >= most)
        {
            RemoveOldest();
        }

        if (joins.Count == 0)
        {
            pace = Pace; // not for each: else who sends one cookie after another would keep the older joins from being sent again
            tries = 0;
        }

        joins.Add(join);
        unsent = join;
        Due = now;
    }

    /// <summary>Wipes the keys of the handshakes that were not finished.</summary>
    public void Dispose()
    {
        while (joins.Count > 0)
        {
            RemoveOldest();
        }
    }

    /// <summary>Takes the welcome that answers a join.</summary>
    internal void Take(in WelcomeDatagram welcome, PreparedJoin? answered, SimTime now)
    {
        IsWelcome = true;
        Took = answered is null ? SimDuration.Zero : now - answered.Made;
        Dispose();
        LogStart = welcome.LogIndex;
        CopyHash = welcome.CopyHash;
        Download = new SnapshotDownload(welcome.CopyLength, now);
    }

    private void RemoveOldest()
    {
        unsent = unsent == joins[0] ? null : unsent;
        joins[0].Dispose();
        joins.RemoveAt(0);
    }
}
