using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>A crossing as a game hears of it: a body enters or leaves a sensor.</summary>
/// <remarks>
/// Immutable, safe on any thread. The crossing has the same bits on every peer. <see cref="Number"/>, and which crossings come as predicted,
/// are each peer's own.
/// </remarks>
public readonly struct CrossingNotice : IEquatable<CrossingNotice>, INotice<CrossingNotice>
{
    private readonly NoticeStamp stamp;

    internal CrossingNotice(in Crossing crossing)
        : this(default, crossing)
    {
    }

    private CrossingNotice(in NoticeStamp stamp, in Crossing crossing)
    {
        this.stamp = stamp;
        Crossing = crossing;
    }

    /// <summary>Whether it is predicted, moved, in doubt, confirmed, retracted or unresolved.</summary>
    public NoticeKind Kind => stamp.Kind;

    /// <summary>
    /// Counts the notices of this peer from 1, lost ones included: a gap is one that found no room; see <see cref="CrossingNotices.Lost"/>.
    /// </summary>
    public long Number => stamp.Number;

    /// <summary>
    /// Which crossing it is, the same in all notices of it: the <see cref="Number"/> of the one that predicted it. A late event may change its
    /// instant and all else; this stays.
    /// </summary>
    public long Id => stamp.Id;

    /// <summary>The instant that was told before, where it was <see cref="NoticeKind.Moved"/>; otherwise <see cref="Time"/>.</summary>
    public SimTime MovedFrom => stamp.MovedFrom;

    /// <summary>The crossing.</summary>
    public Crossing Crossing { get; }

    /// <summary>The event.</summary>
    public EventKey Key => Crossing.Key;

    /// <summary>When it happens, in shared simulation time.</summary>
    public SimTime Time => Crossing.Time;

    /// <summary>The body.</summary>
    public BodyId Body => Crossing.Body;

    /// <summary>The index of the sensor in <see cref="Scene.Sensors"/>.</summary>
    public int Sensor => Crossing.Sensor;

    /// <summary>Whether the body enters; if not, it leaves.</summary>
    public bool Entered => Crossing.Entered;

    int INotice<CrossingNotice>.CompareWith(CrossingNotice other) => EventKey.Compare(Key, other.Key);

    int INotice<CrossingNotice>.CompareSeries(CrossingNotice other)
    {
        int byBody = Body.CompareTo(other.Body);
        int bySensor = byBody != 0 ? byBody : Sensor.CompareTo(other.Sensor);
        return bySensor != 0 ? bySensor : Entered.CompareTo(other.Entered);
    }

    bool INotice<CrossingNotice>.IsSameAs(CrossingNotice other) => Crossing == other.Crossing;

    CrossingNotice INotice<CrossingNotice>.As(in NoticeStamp stamp) => new(stamp, Crossing);

    /// <inheritdoc/>
    public bool Equals(CrossingNotice other) =>
        Kind == other.Kind && Number == other.Number && Id == other.Id && MovedFrom == other.MovedFrom && Crossing == other.Crossing;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is CrossingNotice other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Crossing.GetHashCode();

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in CrossingNotice a, in CrossingNotice b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in CrossingNotice a, in CrossingNotice b) => !a.Equals(b);

    /// <summary>Kind, body, sensor and time, for logs.</summary>
    public override string ToString() => string.Format(CultureInfo.InvariantCulture, "{0}: {1}", Kind, Crossing);
}
