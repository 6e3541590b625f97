using System;
using LagSim.Time;

namespace LagSim.Testing.Links;

/// <summary>When a datagram arrives: never, once or twice.</summary>
/// <remarks>Immutable, safe on any thread, allocates nothing. <c>default</c> is a lost datagram.</remarks>
internal readonly struct LinkDeliveries
{
    private readonly SimTime first;
    private readonly SimTime second;

    internal LinkDeliveries(SimTime only)
    {
        Count = 1;
        first = second = only;
    }

    internal LinkDeliveries(SimTime first, SimTime second)
    {
        Count = 2;
        this.first = first;
        this.second = second;
    }

    /// <summary>How often it arrives: 0, 1 or 2.</summary>
    public int Count { get; }

    /// <summary>The datagram's arrival (0), or that of its copy (1), which is never the earlier.</summary>
    /// <exception cref="ArgumentOutOfRangeException"><paramref name="index"/> is not below <see cref="Count"/>.</exception>
    public SimTime this[int index] =>
        index >= 0 && index < Count
            ? (index == 0 ? first : second)
            : throw new ArgumentOutOfRangeException(nameof(index), index, $"The datagram arrives {Count} times.");
}
