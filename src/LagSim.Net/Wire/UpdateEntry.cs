using LagSim.Events;

namespace LagSim.Net.Wire;

/// <summary>An external event and what the host said about it, as one entry of an <see cref="UpdateDatagram"/>.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is no entry.</remarks>
internal readonly struct UpdateEntry
{
    private readonly uint sequence;

    /// <summary>An entry that tells the event.</summary>
    public UpdateEntry(Verdict verdict, in ExternalEvent what)
    {
        Verdict = verdict;
        Event = what;
        sequence = what.Sequence;
    }

    /// <summary>An entry for who did it, and so has the event: only its number.</summary>
    public UpdateEntry(Verdict verdict, uint ownSequence)
    {
        Verdict = verdict;
        Event = default;
        sequence = ownSequence;
        IsOwn = true;
    }

    /// <summary>What the host said.</summary>
    public Verdict Verdict { get; }

    /// <summary>Whether the event is the addressee's own, of which only the number travels.</summary>
    public bool IsOwn { get; }

    /// <summary>The event's number at the peer who did it.</summary>
    public uint Sequence => sequence;

    /// <summary>The event; the default of an own one.</summary>
    public ExternalEvent Event { get; }
}
