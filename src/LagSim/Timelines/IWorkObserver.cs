using System;
using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>
/// Is told of all that a simulation does, event by event, what it does again included: who took part, and how much it was. On the thread
/// that advances; it may change nothing.
/// </summary>
internal interface IWorkObserver
{
    /// <summary>An event was processed, or it was looked again what a body meets next.</summary>
    /// <param name="key">The event; of a player's act with whose it was.</param>
    /// <param name="bodies">The bodies that took part, as places in the table. To be read only: it is the world's own, and a read-only span
    /// is what not every runtime links.</param>
    /// <param name="amount">How much work it was, in units of about a microsecond.</param>
    /// <param name="isAgain">Whether that instant was simulated before, and a late event rewound the world.</param>
    /// <param name="table">Whose places these are.</param>
    /// <returns>Whether the advance goes on.</returns>
    WorkVerdict OnWork(in EventKey key, Span<int> bodies, double amount, bool isAgain, BodyTable table);
}
