using System;
using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>
/// Notified of all work of a simulation, event by event, including re-simulation: which bodies took part, and how much it was. Called on
/// the thread that advances; it may change nothing.
/// </summary>
internal interface IWorkObserver
{
    /// <summary>An event was processed, or a body's next event was predicted again.</summary>
    /// <param name="key">The event; for a player's action it includes the player.</param>
    /// <param name="bodies">The bodies that took part, as places in the table. Do not write to it: it is the world's own, and not every
    /// runtime links a read-only span.</param>
    /// <param name="amount">How much work it was, in units of about a microsecond.</param>
    /// <param name="isAgain">Whether that instant was simulated before, and a late event rewound the world.</param>
    /// <param name="table">The table of these places.</param>
    /// <returns>Whether the advance continues.</returns>
    WorkVerdict OnWork(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table);

    /// <summary>Rules were called for an event, or a call of theirs was found to stand.</summary>
    /// <param name="key">The event; for a command it includes the player.</param>
    /// <param name="bodies">The bodies that took part in it, as for work; none for a command, a timer and the start.</param>
    /// <param name="amount">How much work the call is, and what the rules said of what they do in it, in units of about a microsecond.</param>
    /// <param name="isAgain">As for work.</param>
    /// <param name="table">The table of these places.</param>
    /// <returns>Whether the advance continues.</returns>
    WorkVerdict OnCall(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table);
}
