using LagSim.Events;

namespace LagSim.Hosting;

/// <summary>What a <see cref="NoticeLedger{T}"/> has to know of what it keeps account of.</summary>
internal interface INotice<T>
    where T : struct
{
    /// <summary>The event it belongs to.</summary>
    EventKey Key { get; }

    /// <summary>Negative, zero or positive as it comes before the other, is about the same, or comes after it; by key first.</summary>
    int CompareWith(T other);

    /// <summary>Whether it says the same, to the bit, whatever its kind and number.</summary>
    bool IsSameAs(T other);

    /// <summary>The same of another kind, and with another number.</summary>
    T As(NoticeKind kind, long number);
}
