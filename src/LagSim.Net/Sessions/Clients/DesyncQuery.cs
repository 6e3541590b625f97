using System.Collections.Generic;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's query for the host's events in a span of time: what has arrived, and when to ask again.</summary>
/// <remarks>Events are taken one at a time, and no more than a host keeps, so memory grows only with what was received.</remarks>
internal sealed class DesyncQuery
{
    private readonly List<LogEntry> events = new();
    private uint asked;

    internal DesyncQuery(SimTime after, SimTime upTo, SimTime now)
    {
        After = after;
        UpTo = upTo;
        Began = now;
        Due = now;
    }

    internal SimTime After { get; }

    internal SimTime UpTo { get; }

    /// <summary>When it began, by the local clock.</summary>
    internal SimTime Began { get; }

    /// <summary>When to ask again, by the local clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>Whether everything the host has is here.</summary>
    internal bool IsComplete { get; private set; }

    /// <summary>Whether the host still had all the events of the span.</summary>
    internal bool IsWhole { get; private set; } = true;

    /// <summary>The host's accepted events that have arrived so far.</summary>
    internal List<LogEntry> Events => events;

    internal DesyncQueryDatagram Ask(ulong sessionId, byte peer, SimTime now, SimDuration timeout)
    {
        Due = now + timeout;
        return new DesyncQueryDatagram(sessionId, peer, ++asked, After, UpTo, (uint)events.Count);
    }

    /// <summary>Takes a report from the host; false if it is not the next one, or not what was asked for.</summary>
    internal bool Take(in DesyncReportDatagram report, SimTime now)
    {
        bool hasEvent = report.Total > 0;
        bool fits = !IsComplete && report.Total <= RecentEvents.Most && report.Index == events.Count
            && (hasEvent ? report.Event.Time > After && report.Event.Time <= UpTo : events.Count == 0);
        if (!fits)
        {
            return false;
        }

        if (hasEvent)
        {
            events.Add(new LogEntry(report.LogIndex, Verdict.Accepted, report.Event));
        }

        IsWhole = report.IsWhole;
        IsComplete = events.Count == report.Total;
        if (events.Count % DesyncQueryDatagram.MaxEvents == 0)
        {
            Due = now; // one query's worth is here: ask for the next
        }

        return true;
    }
}
