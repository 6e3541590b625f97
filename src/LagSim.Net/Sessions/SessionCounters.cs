using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// The counters of a session. Those of <see cref="Session.Counters"/> keep changing: read them on the session's thread, or once it has
/// stopped.
/// </summary>
/// <remarks>A <see cref="Copy"/> never changes and is safe on any thread.</remarks>
public sealed class SessionCounters
{
    /// <summary>The number of lateness samples kept; further ones are only counted.</summary>
    public const int MaxKeptLatenesses = 100_000;

    // Append-only, and replaced when it grows, so that copies can share it.
    private SimDuration[] lateness = Array.Empty<SimDuration>();
    private int latenessCount;

    internal SessionCounters()
    {
    }

    private SessionCounters(SessionCounters other)
    {
        DatagramsReceived = other.DatagramsReceived;
        DatagramsMalformed = other.DatagramsMalformed;
        DatagramsIgnored = other.DatagramsIgnored;
        DatagramsForged = other.DatagramsForged;
        DatagramsSent = other.DatagramsSent;
        EventsAccepted = other.EventsAccepted;
        EventsRefused = other.EventsRefused;
        EventsMoved = other.EventsMoved;
        EventsLost = other.EventsLost;
        EventsUnanswered = other.EventsUnanswered;
        Renewals = other.Renewals;
        Heals = other.Heals;
        LastShown = other.LastShown;
        EventsForged = other.EventsForged;
        EventsDeferred = other.EventsDeferred;
        StatesAgreed = other.StatesAgreed;
        StatesDiffered = other.StatesDiffered;
        FirstDifference = other.FirstDifference;
        lateness = other.lateness;
        latenessCount = other.latenessCount;
    }

    /// <summary>Datagrams received, refused ones included.</summary>
    public long DatagramsReceived { get; internal set; }

    /// <summary>Datagrams received that are not valid in this protocol.</summary>
    public long DatagramsMalformed { get; internal set; }

    /// <summary>Valid datagrams that do not belong here: from another session, a stranger, or an earlier time.</summary>
    public long DatagramsIgnored { get; internal set; }

    /// <summary>
    /// Datagrams to a protected session that nobody of the session sealed: forged, changed on the way, or not protected at all. One that
    /// was sealed and comes again counts as <see cref="DatagramsIgnored"/>.
    /// </summary>
    public long DatagramsForged { get; internal set; }

    /// <summary>Datagrams sent.</summary>
    public long DatagramsSent { get; internal set; }

    /// <summary>Accepted events, own ones included.</summary>
    public long EventsAccepted { get; internal set; }

    /// <summary>Events that the host refused, own ones included.</summary>
    public long EventsRefused { get; internal set; }

    /// <summary>Accepted events that came too late for their stamps, and happened later (<see cref="Wire.Verdict.Moved"/>), own ones included.</summary>
    public long EventsMoved { get; internal set; }

    /// <summary>
    /// Accepted events that came too late for this peer's remaining history, and own refused events that could no longer be retracted. With
    /// a strategy that promises agreement the peer then gets a fresh snapshot.
    /// </summary>
    public long EventsLost { get; internal set; }

    /// <summary>
    /// A client's own events that got no verdict because its world was replaced first; the new world shows whether they happened.
    /// </summary>
    public long EventsUnanswered { get; internal set; }

    /// <summary>How often a fresh snapshot of the host's world replaced this peer's.</summary>
    public long Renewals { get; internal set; }

    /// <summary>
    /// Late events of other peers for which timelines were rewritten back to the event; none with a strategy that does not rewrite the
    /// past.
    /// </summary>
    public long Heals { get; internal set; }

    /// <summary>
    /// The shared time at which a render snapshot first showed the newest event of any peer; the earliest instant before any.
    /// </summary>
    public SimTime LastShown { get; internal set; } = SimTime.MinValue;

    /// <summary>Refused events that were sent in another player's name; they are in no log.</summary>
    public long EventsForged { get; internal set; }

    /// <summary>Client events that were deferred because a client exceeded <see cref="HostOptions.MaxEventsPerSecond"/>.</summary>
    public long EventsDeferred { get; internal set; }

    /// <summary>The number of this client's committed states that agreed with the host's.</summary>
    public long StatesAgreed { get; internal set; }

    /// <summary>The number of those that differed.</summary>
    public long StatesDiffered { get; internal set; }

    /// <summary>The time of the first committed state that differed; the earliest instant if none did.</summary>
    public SimTime FirstDifference { get; internal set; } = SimTime.MinValue;

    /// <summary>The lateness of other peers' events: arrival minus stamp; negative for those that came early.</summary>
    public IReadOnlyList<SimDuration> Lateness => new ArraySegment<SimDuration>(lateness, 0, latenessCount);

    /// <summary>
    /// Takes an immutable copy of the counters. Take it on the session's thread, see <see cref="PeerThread.Ask"/>; read it on any.
    /// </summary>
    /// <remarks>Cheap, however much was counted.</remarks>
    public SessionCounters Copy() => new(this);

    /// <summary>Counts a datagram that could not be decoded, and returns whether it could.</summary>
    internal bool IsWellFormed(bool decoded)
    {
        DatagramsMalformed += decoded ? 0 : 1;
        return decoded;
    }

    internal void Count(bool agrees, SimTime time)
    {
        StatesAgreed += agrees ? 1 : 0;
        StatesDiffered += agrees ? 0 : 1;
        FirstDifference = agrees || FirstDifference != SimTime.MinValue ? FirstDifference : time;
    }

    internal void AddLateness(SimDuration span)
    {
        if (latenessCount == MaxKeptLatenesses)
        {
            return;
        }

        if (latenessCount == lateness.Length)
        {
            Array.Resize(ref lateness, Math.Min(MaxKeptLatenesses, Math.Max(16, 2 * latenessCount)));
        }

        lateness[latenessCount++] = span;
    }
}
