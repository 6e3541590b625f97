using LagSim.Events;

namespace LagSim.Net.Wire;

/// <summary>An external event and what the host said about it, as one entry of an <see cref="UpdateDatagram"/>.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is no entry.</remarks>
public readonly struct UpdateEntry
{
    /// <summary>An entry of these two.</summary>
    public UpdateEntry(Verdict verdict, in ExternalEvent what)
    {
        Verdict = verdict;
        Event = what;
    }

    /// <summary>What the host said.</summary>
    public Verdict Verdict { get; }

    /// <summary>The event.</summary>
    public ExternalEvent Event { get; }
}
