using System.Collections.Generic;
using LagSim.Events;
using LagSim.Net.Sessions.Links;
using LagSim.Net.Wire;

namespace LagSim.Net.Sessions.Clients;

/// <summary>A client's own events whose verdict has not come, oldest first; their numbers follow one another.</summary>
internal sealed class OwnEvents : IEntrySource
{
    private readonly List<ExternalEvent> events = new();
    private int taken; // so many at the beginning are validated

    /// <param name="last">The number that the first event comes after.</param>
    internal OwnEvents(uint last) => Last = last;

    /// <summary>How many there are.</summary>
    internal int Count => events.Count - taken;

    /// <summary>The oldest.</summary>
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

    /// <summary>Takes the oldest out.</summary>
    internal ExternalEvent Take()
    {
        ExternalEvent oldest = events[taken++];
        if (taken > events.Count / 2)
        {
            events.RemoveRange(0, taken); // half at least, so that an event is moved once in the mean
            taken = 0;
        }

        return oldest;
    }
}
