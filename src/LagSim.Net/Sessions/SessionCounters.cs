using System;
using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>
/// What a session counted. That of <see cref="Session.Counters"/> goes on counting: read it on the session's thread, or once that has
/// stopped.
/// </summary>
/// <remarks>A <see cref="Copy"/> never changes and is safe on any thread.</remarks>
public sealed class SessionCounters
{
    /// <summary>How many latenesses are kept; further ones only count.</summary>
    public const int MaxKeptLatenesses = 100_000;

    // Only ever added to, and a longer one takes its place: the copies share what they have of it.
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
        DatagramsSent = other.DatagramsSent;
        EventsAccepted = other.EventsAccepted;
        EventsRefused = other.EventsRefused;
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

    /// <summary>Datagrams that came in, refused ones included.</summary>
    public long DatagramsReceived { get; internal set; }

    /// <summary>Datagrams that were no valid datagram of this protocol.</summary>
    public long DatagramsMalformed { get; internal set; }

    /// <summary>Valid datagrams that had no business here: another session's, a stranger's, an old one.</summary>
    public long DatagramsIgnored { get; internal set; }

    /// <summary>Datagrams sent.</summary>
    public long DatagramsSent { get; internal set; }

    /// <summary>Accepted events, one's own included.</summary>
    public long EventsAccepted { get; internal set; }

    /// <summary>Events that the host refused, one's own included.</summary>
    public long EventsRefused { get; internal set; }

    /// <summary>
    /// Accepted events that came too late for the history this peer still had, and own refused ones that were no longer there to be taken
    /// back. A peer of a strategy that promises agreement then gets a fresh copy of the world.
    /// </summary>
    public long EventsLost { get; internal set; }

    /// <summary>
    /// Own events of a client on which it has heard no verdict, because its world was replaced first: whether they happened, the new one
    /// shows.
    /// </summary>
    public long EventsUnanswered { get; internal set; }

    /// <summary>How often a fresh copy of the host's world took the place of this peer's.</summary>
    public long Renewals { get; internal set; }

    /// <summary>
    /// Late events of other peers for which timelines were rewritten back to the event; none with a strategy that rewrites no past.
    /// </summary>
    public long Heals { get; internal set; }

    /// <summary>
    /// The shared time at which a render snapshot first showed the newest event, one's own or another's; the earliest instant before any.
    /// </summary>
    public SimTime LastShown { get; internal set; } = SimTime.MinValue;

    /// <summary>Of the refused ones those that came in another's name; they stand in no log.</summary>
    public long EventsForged { get; internal set; }

    /// <summary>
    /// Events of clients that were left for later because a client did more than <see cref="HostOptions.MaxEventsPerSecond"/>.
    /// </summary>
    public long EventsDeferred { get; internal set; }

    /// <summary>How many of this client's committed states were like the host's.</summary>
    public long StatesAgreed { get; internal set; }

    /// <summary>How many were not.</summary>
    public long StatesDiffered { get; internal set; }

    /// <summary>The time of the first committed state that was not; the earliest instant if none was.</summary>
    public SimTime FirstDifference { get; internal set; } = SimTime.MinValue;

    /// <summary>By how much the events of other peers came after their own time; negative for those that came before.</summary>
    public IReadOnlyList<SimDuration> Lateness => new ArraySegment<SimDuration>(lateness, 0, latenessCount);

    /// <summary>
    /// What was counted up to now, which stays as it is. Taken on the session's thread, it may be read on any: see
    /// <see cref="PeerThread.Ask"/>.
    /// </summary>
    /// <remarks>Cheap, however much was counted.</remarks>
    public SessionCounters Copy() => new(this);

    /// <summary>Counts a datagram that could not be decoded; whether it could.</summary>
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
