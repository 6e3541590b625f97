using System.Collections.Generic;
using LagSim.Net.Sessions.Core;

namespace LagSim.Net.Sessions.Clients;

/// <summary>The first event in which two peers' logs of a span of time differ, in both versions; empty if they are equal.</summary>
internal readonly struct EventDifference
{
    private EventDifference(LogEntry? hosts, LogEntry? own, bool hasOwnEffect)
    {
        Hosts = hosts;
        Own = own;
        HasOwnEffect = hasOwnEffect;
    }

    /// <summary>Whether there is no difference.</summary>
    internal bool IsNone => Hosts is null && Own is null;

    /// <summary>The host's version; null if it has no such event.</summary>
    internal LogEntry? Hosts { get; }

    /// <summary>This peer's version; null if it never received the event.</summary>
    internal LogEntry? Own { get; }

    /// <summary>Whether the event took effect here.</summary>
    internal bool HasOwnEffect { get; }

    /// <summary>Finds the first event that only one side has, or that the two have in different versions.</summary>
    /// <param name="theirs">The host's events, in the order of <see cref="RecentEvents.Compare"/>.</param>
    /// <param name="own">This peer's events that took effect, in that order.</param>
    /// <param name="recent">All recent events of this peer.</param>
    internal static EventDifference First(List<LogEntry> theirs, List<LogEntry> own, RecentEvents recent)
    {
        int same = 0;
        while (same < theirs.Count && same < own.Count && theirs[same].Event.Equals(own[same].Event))
        {
            same++;
        }

        LogEntry? hosts = same < theirs.Count ? theirs[same] : null;
        LogEntry? mine = same < own.Count ? own[same] : null;
        if (hosts is null && mine is null)
        {
            return default;
        }

        if (mine is not LogEntry here || (hosts is LogEntry there && RecentEvents.Compare(there, here) <= 0))
        {
            bool isKnown = recent.TryFind(hosts!.Value.Event, out LogEntry version, out bool hasEffect);
            return new EventDifference(hosts, isKnown ? version : null, hasEffect);
        }

        int at = theirs.FindIndex(e => e.Event.Peer == here.Event.Peer && e.Event.Sequence == here.Event.Sequence);
        return new EventDifference(at < 0 ? null : theirs[at], here, true);
    }
}
