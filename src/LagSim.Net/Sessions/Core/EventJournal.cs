using System;

namespace LagSim.Net.Sessions.Core;

/// <summary>Tells every line of the log once it has taken effect here, and keeps the newest: what a difference is explained by.</summary>
internal sealed class EventJournal
{
    /// <summary>Raised for every line, in order.</summary>
    internal event Action<LogEntry>? Told;

    /// <summary>The newest lines.</summary>
    internal RecentEvents Recent { get; private set; } = new();

    /// <param name="entry">The line.</param>
    /// <param name="hasEffect">Whether its event is in this peer's world; false for an accepted one that came too late for the history
    /// here.</param>
    internal void Tell(in LogEntry entry, bool hasEffect)
    {
        Recent.Add(entry, hasEffect);
        Told?.Invoke(entry);
    }

    /// <summary>Forgets all lines: they are another world's.</summary>
    internal void Clear() => Recent = new RecentEvents();
}
