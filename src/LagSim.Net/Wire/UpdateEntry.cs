using LagSim.Events;

namespace LagSim.Net.Wire;

/// <summary>An external event and the host's verdict on it, as one entry of an <see cref="UpdateDatagram"/>.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is no entry.</remarks>
internal readonly struct UpdateEntry
{
    private readonly uint sequence;

    /// <summary>Creates an entry with the whole event.</summary>
    public UpdateEntry(Verdict verdict, in ExternalEvent what)
    {
        Verdict = verdict;
        Event = what;
        sequence = what.Sequence;
    }

    /// <summary>Creates an entry for the author of the event, which has it already: only its number.</summary>
    public UpdateEntry(Verdict verdict, uint ownSequence)
    {
        Verdict = verdict;
        Event = default;
        sequence = ownSequence;
        IsOwn = true;
    }

    /// <summary>The host's verdict.</summary>
    public Verdict Verdict { get; }

    /// <summary>Whether the event is the addressee's own, of which only the number is sent.</summary>
    public bool IsOwn { get; }

    /// <summary>The event's sequence number at its author.</summary>
    public uint Sequence => sequence;

    /// <summary>The event; the default for an own one.</summary>
    public ExternalEvent Event { get; }
}
