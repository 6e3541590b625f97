using System;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// Raises an event for every log entry once it has taken effect here, and keeps the newest entries to explain a divergence.
/// </summary>
internal sealed class EventJournal
{
    /// <summary>Raised for every entry, in order.</summary>
    internal event Action<LogEntry>? Told;

    /// <summary>The newest entries.</summary>
    internal RecentEvents Recent { get; private set; } = new();

    /// <param name="entry">The entry.</param>
    /// <param name="hasEffect">
    /// Whether its event is in this peer's world; false for an accepted one that came too late for the history here.
    /// </param>
    internal void Tell(in LogEntry entry, bool hasEffect)
    {
        Recent.Add(entry, hasEffect);
        Told?.Invoke(entry);
    }

    /// <summary>Forgets all entries, because they belong to another world.</summary>
    internal void Clear() => Recent = new RecentEvents();
}
