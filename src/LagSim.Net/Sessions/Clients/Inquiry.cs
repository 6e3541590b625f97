using System.Collections.Generic;
using LagSim.Net.Sessions.Core;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's asking for the host's events of a span of time: what has come, and when to ask again.</summary>
/// <remarks>Takes in one event after the other, at most as many as a host keeps, so that memory follows what was received.</remarks>
internal sealed class Inquiry
{
    private readonly List<LogEntry> events = new();
    private uint asked;

    internal Inquiry(SimTime after, SimTime upTo, SimTime now)
    {
        After = after;
        UpTo = upTo;
        Began = now;
        Due = now;
    }

    internal SimTime After { get; }

    internal SimTime UpTo { get; }

    /// <summary>When it was begun, by the own clock.</summary>
    internal SimTime Began { get; }

    /// <summary>When to ask again, by the own clock.</summary>
    internal SimTime Due { get; private set; }

    /// <summary>Whether all that the host has is here.</summary>
    internal bool IsComplete { get; private set; }

    /// <summary>Whether the host still had all of it.</summary>
    internal bool IsWhole { get; private set; } = true;

    /// <summary>The host's accepted events, as far as they have come.</summary>
    internal List<LogEntry> Events => events;

    internal DesyncQueryDatagram Ask(ulong sessionId, byte peer, SimTime now, SimDuration timeout)
    {
        Due = now + timeout;
        return new DesyncQueryDatagram(sessionId, peer, ++asked, After, UpTo, (uint)events.Count);
    }

    /// <summary>Takes in what the host tells; false for what is not the next, or not what was asked for.</summary>
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
            Due = now; // all that is told at once
        }

        return true;
    }
}
