using System.Collections.Generic;
using LagSim.Time;

namespace LagSim.Net.Sessions;

/// <summary>What a session counted. Written on its thread; read it there, or once it has stopped.</summary>
public sealed class SessionCounters
{
    /// <summary>How many latenesses are kept; further ones only count.</summary>
    public const int MaxKeptLatenesses = 100_000;

    private readonly List<SimDuration> lateness = new();

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
    /// back. Its world may differ from then on.
    /// </summary>
    public long EventsLost { get; internal set; }

    /// <summary>Late events of other peers for which timelines were rewritten back to the event; none with a strategy that rewrites no past.</summary>
    public long Heals { get; internal set; }

    /// <summary>The shared time at which a picture first showed the newest event, one's own or another's; the earliest instant before any.</summary>
    public SimTime LastShown { get; internal set; } = SimTime.MinValue;

    /// <summary>Of the refused ones those that came in another's name; they stand in no log.</summary>
    public long EventsForged { get; internal set; }

    /// <summary>Events of joiners that were left for later because a joiner did more than <see cref="SessionOptions.MaxEventsPerSecond"/>.</summary>
    public long EventsDeferred { get; internal set; }

    /// <summary>How many of this joiner's committed states were like the host's.</summary>
    public long StatesAgreed { get; internal set; }

    /// <summary>How many were not.</summary>
    public long StatesDiffered { get; internal set; }

    /// <summary>The time of the first committed state that was not; the earliest instant if none was.</summary>
    public SimTime FirstDifference { get; internal set; } = SimTime.MinValue;

    /// <summary>By how much the events of other peers came after their own time; negative for those that came before.</summary>
    public IReadOnlyList<SimDuration> Lateness => lateness;

    internal void Count(bool agrees, SimTime time)
    {
        StatesAgreed += agrees ? 1 : 0;
        StatesDiffered += agrees ? 0 : 1;
        FirstDifference = agrees || FirstDifference != SimTime.MinValue ? FirstDifference : time;
    }

    internal void AddLateness(SimDuration span)
    {
        if (lateness.Count < MaxKeptLatenesses)
        {
            lateness.Add(span);
        }
    }
}
