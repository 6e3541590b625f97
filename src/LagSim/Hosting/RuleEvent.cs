using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>Something that the rules of a game told, and what is known of it.</summary>
/// <remarks>Immutable, safe on any thread. Key, place and notice are the same on every peer; <see cref="Number"/>, and which come as
/// predicted, are each peer's own.</remarks>
public readonly struct RuleEvent : IEquatable<RuleEvent>, INotice<RuleEvent>
{
    private readonly NoticeStamp stamp;

    internal RuleEvent(in EventKey key, int place, RuleNotice notice)
        : this(default, key, place, notice)
    {
    }

    private RuleEvent(in NoticeStamp stamp, in EventKey key, int place, RuleNotice notice)
    {
        this.stamp = stamp;
        Key = key;
        Place = place;
        Notice = notice;
    }

    /// <summary>Whether it is predicted, moved, in doubt, confirmed, retracted or unresolved.</summary>
    public NoticeKind Kind => stamp.Kind;

    /// <summary>Counts those of this peer from 1, lost ones included; see <see cref="RuleNotices.Lost"/>.</summary>
    public long Number => stamp.Number;

    /// <summary>
    /// Which thing it is, the same in all notices of it: the <see cref="Number"/> of the one that predicted it. A late event may change its
    /// instant and all else; this stays.
    /// </summary>
    public long Id => stamp.Id;

    /// <summary>The instant that was told before, where it was <see cref="NoticeKind.Moved"/>; otherwise <see cref="Time"/>.</summary>
    public SimTime MovedFrom => stamp.MovedFrom;

    /// <summary>The event for which the rules were called.</summary>
    public EventKey Key { get; }

    /// <summary>When the rules told it, in shared simulation time.</summary>
    public SimTime Time => Key.Time;

    /// <summary>Which it is of those that the rules told for that event, from 0.</summary>
    public int Place { get; }

    /// <summary>What they told.</summary>
    public RuleNotice Notice { get; }

    /// <summary>Whether it is about the same, whatever its kind.</summary>
    public bool IsSameNotice(in RuleEvent other) => Key == other.Key && Place == other.Place && Notice == other.Notice;

    int INotice<RuleEvent>.CompareWith(RuleEvent other)
    {
        int byKey = EventKey.Compare(Key, other.Key);
        return byKey != 0 ? byKey : Place.CompareTo(other.Place);
    }

    int INotice<RuleEvent>.CompareSeries(RuleEvent other)
    {
        int byCode = Notice.Code.CompareTo(other.Notice.Code);
        return byCode != 0 ? byCode : Notice.Key.CompareTo(other.Notice.Key);
    }

    bool INotice<RuleEvent>.IsSameAs(RuleEvent other) => IsSameNotice(other);

    RuleEvent INotice<RuleEvent>.As(in NoticeStamp stamp) => new(stamp, Key, Place, Notice);

    /// <inheritdoc/>
    public bool Equals(RuleEvent other) =>
        Kind == other.Kind && Number == other.Number && Id == other.Id && MovedFrom == other.MovedFrom && IsSameNotice(other);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is RuleEvent other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Key.GetHashCode() ^ Place;

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in RuleEvent a, in RuleEvent b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in RuleEvent a, in RuleEvent b) => !a.Equals(b);

    /// <summary>Kind, notice and time, for logs.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "{0} {1} at {2}", Kind, Notice, Time.ToShortString());
}
