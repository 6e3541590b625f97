using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's own events that have no verdict yet, oldest first, with consecutive numbers.</summary>
internal sealed class OwnEvents : IEntrySource
{
    private readonly List<ExternalEvent> events = new();
    private int taken; // the number of leading events that already have a verdict

    /// <param name="last">The number before that of the first event.</param>
    internal OwnEvents(uint last) => Last = last;

    /// <summary>The number of events.</summary>
    internal int Count => events.Count - taken;

    /// <summary>The oldest event.</summary>
    internal ExternalEvent Oldest => events[taken];

    /// <inheritdoc/>
    public uint Last { get; private set; }

    /// <inheritdoc/>
    public UpdateEntry this[uint number] => new(Verdict.Pending, events[taken + (int)(number - Oldest.Sequence)]);

    internal void Add(in ExternalEvent external)
    {
        events.Add(external);
        Last = external.Sequence;
    }

    /// <summary>Removes the oldest event.</summary>
    internal ExternalEvent Take()
    {
        ExternalEvent oldest = events[taken++];
        if (taken > events.Count / 2)
        {
            events.RemoveRange(0, taken); // half at least, so that an event is moved once on average
            taken = 0;
        }

        return oldest;
    }
}
