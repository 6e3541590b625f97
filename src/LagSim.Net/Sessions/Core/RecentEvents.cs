using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>The newest log entries, kept beyond the settled ones to explain a state that turns out to differ.</summary>
/// <remarks>Bounded; memory is allocated as entries arrive.</remarks>
internal sealed class RecentEvents
{
    /// <summary>The number of entries kept: half a minute of a lively session, and at most some 200 KB.</summary>
    internal const int Most = 1024;

    private readonly List<(LogEntry Entry, bool HasEffect)> lines = new();
    private int oldest; // once the list is full
    private SimTime forgotten = SimTime.MinValue; // the greatest stamp of an accepted event that was dropped

    internal void Add(in LogEntry entry, bool hasEffect)
    {
        if (lines.Count < Most)
        {
            lines.Add((entry, hasEffect));
            return;
        }

        LogEntry gone = lines[oldest].Entry;
        forgotten = gone.Verdict.IsAcceptance() ? SimTime.Max(forgotten, gone.Event.Time) : forgotten;
        lines[oldest] = (entry, hasEffect);
        oldest = (oldest + 1) % Most;
    }

    /// <summary>Whether every accepted event stamped after that time is still here.</summary>
    internal bool IsWholeAfter(SimTime after) => forgotten <= after;

    /// <summary>
    /// Returns the accepted events stamped after one time and up to another that took effect here, in the order of <see cref="Compare"/>.
    /// </summary>
    internal List<LogEntry> Between(SimTime after, SimTime upTo)
    {
        List<LogEntry> found = new();
        foreach ((LogEntry entry, bool hasEffect) in lines)
        {
            if (hasEffect && entry.Verdict.IsAcceptance() && entry.Event.Time > after && entry.Event.Time <= upTo)
            {
                found.Add(entry);
            }
        }

        found.Sort(Compare);
        return found;
    }

    /// <summary>The entries about a player's events that happened, in no order.</summary>
    internal IEnumerable<LogEntry> Accepted(byte player)
    {
        foreach ((LogEntry entry, _) in lines)
        {
            if (entry.Event.Peer == player && entry.Verdict.IsAcceptance())
            {
                yield return entry;
            }
        }
    }

    /// <summary>Finds the newest entry about an event, whatever its verdict, and whether it took effect; false if there is none.</summary>
    internal bool TryFind(in ExternalEvent what, out LogEntry entry, out bool hasEffect)
    {
        entry = default;
        hasEffect = false;
        foreach ((LogEntry line, bool did) in lines)
        {
            if (line.Event.Peer == what.Peer && line.Event.Sequence == what.Sequence && line.Index > entry.Index)
            {
                (entry, hasEffect) = (line, did);
            }
        }

        return entry.Index > 0;
    }

    /// <summary>
    /// Orders by stamp, then by peer and sequence number. The order is the same on every peer and total over the events of a session.
    /// </summary>
    internal static int Compare(LogEntry a, LogEntry b)
    {
        int order = a.Event.Time.CompareTo(b.Event.Time);
        order = order != 0 ? order : a.Event.Peer.CompareTo(b.Event.Peer);
        return order != 0 ? order : a.Event.Sequence.CompareTo(b.Event.Sequence);
    }
}
