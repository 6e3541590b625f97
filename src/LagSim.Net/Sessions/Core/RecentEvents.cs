using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>The newest lines of the log, kept beyond what is settled: what a state that turns out to differ is explained by.</summary>
/// <remarks>Bounded; takes room as lines come.</remarks>
internal sealed class RecentEvents
{
    /// <summary>So many lines are kept: half a minute of a lively session, and at most some 200 KB.</summary>
    internal const int Most = 1024;

    private readonly List<(LogEntry Entry, bool HasEffect)> lines = new();
    private int oldest; // once there are as many as may be
    private SimTime forgotten = SimTime.MinValue; // the greatest stamp of an accepted event that is no longer here

    internal void Add(in LogEntry entry, bool hasEffect)
    {
        if (lines.Count < Most)
        {
            lines.Add((entry, hasEffect));
            return;
        }

        LogEntry gone = lines[oldest].Entry;
        forgotten = gone.Verdict == Verdict.Accepted ? SimTime.Max(forgotten, gone.Event.Time) : forgotten;
        lines[oldest] = (entry, hasEffect);
        oldest = (oldest + 1) % Most;
    }

    /// <summary>Whether every accepted event stamped after that time is still here.</summary>
    internal bool IsWholeAfter(SimTime after) => forgotten <= after;

    /// <summary>
    /// The accepted events stamped after one time and up to another that have had their effect here, in the order of <see cref="Compare"/>.
    /// </summary>
    internal List<LogEntry> Between(SimTime after, SimTime upTo)
    {
        List<LogEntry> found = new();
        foreach ((LogEntry entry, bool hasEffect) in lines)
        {
            if (hasEffect && entry.Verdict == Verdict.Accepted && entry.Event.Time > after && entry.Event.Time <= upTo)
            {
                found.Add(entry);
            }
        }

        found.Sort(Compare);
        return found;
    }

    /// <summary>
    /// The newest line about that event, whatever its verdict, and whether it has had its effect; false if there is none.
    /// </summary>
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
    /// By stamp, then by who did it as which of his: the same on every peer, and no two events of a session are the same in it.
    /// </summary>
    internal static int Compare(LogEntry a, LogEntry b)
    {
        int order = a.Event.Time.CompareTo(b.Event.Time);
        order = order != 0 ? order : a.Event.Peer.CompareTo(b.Event.Peer);
        return order != 0 ? order : a.Event.Sequence.CompareTo(b.Event.Sequence);
    }
}
