using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>How far a world is simulated, how far back it is kept, and how many events that took.</summary>
/// <remarks>Not thread-safe. The event loop moves both ends on; only a rollback moves <see cref="SimulatedTo"/> back.</remarks>
internal sealed class Progress(SimTime start, SimDuration history, SimTime from)
{
    /// <summary>When the scene began.</summary>
    internal SimTime Start { get; } = start;

    /// <summary>How far behind the simulated time timelines are kept.</summary>
    internal SimDuration History { get; } = history;

    /// <summary>The instant up to which, and including which, everything has happened.</summary>
    internal SimTime SimulatedTo { get; set; } = from - SimDuration.OneTick;

    /// <summary>The earliest instant that can be read or changed.</summary>
    internal SimTime HistoryEdge { get; private set; } = from;

    /// <summary>How many events were processed, those that were simulated again included.</summary>
    internal long EventsProcessed { get; set; }

    /// <summary>How many impacts were among them.</summary>
    internal long ImpactsProcessed { get; set; }

    /// <summary>How many of those closed an instant that would have had no end.</summary>
    internal long ImpactsClosed { get; set; }

    /// <summary>The energy that was lost in those, in J.</summary>
    internal double EnergyLostInClosing { get; set; }

    /// <summary>Moves the edge of the history on, if it is not there yet.</summary>
    internal void ForgetBefore(SimTime time) => HistoryEdge = SimTime.Max(HistoryEdge, time);

    /// <summary>Whether the edge moves on when the world is simulated this far.</summary>
    /// <param name="now">How far it is simulated.</param>
    internal bool IsLongerThanHistory(SimTime now) =>
        (ulong)now.Ticks - (ulong)Start.Ticks > (ulong)History.Ticks; // unsigned: the span since the start may exceed the range of a long
}
