using LagSim.Events;

namespace LagSim.Hosting;

/// <summary>What a <see cref="NoticeLedger{T}"/> has to know of what it keeps account of.</summary>
internal interface INotice<T>
    where T : struct
{
    /// <summary>The event it belongs to.</summary>
    EventKey Key { get; }

    /// <summary>The number of the notice that predicted it.</summary>
    long Id { get; }

    /// <summary>Negative, zero or positive as it comes before the other, is about the same, or comes after it; by key first.</summary>
    int CompareWith(T other);

    /// <summary>Zero if a heal may move the one to the place of the other, as between contacts of one pair; else an order.</summary>
    int CompareSeries(T other);

    /// <summary>Whether it says the same, to the bit, whatever its stamp.</summary>
    bool IsSameAs(T other);

    /// <summary>The same with another stamp.</summary>
    T As(in NoticeStamp stamp);
}
