using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Hosting;

/// <summary>The loss of a body as a game hears of it: its motion cannot be followed any further, so it has left the world.</summary>
/// <remarks>
/// Immutable, safe on any thread. Key, reason, position and velocity have the same bits on every peer. <see cref="Number"/>, and which
/// losses come as predicted, are each peer's own. For the sentence with the body's name and forces see <see cref="Simulation.LostBodies"/>.
/// </remarks>
public readonly struct LossNotice : IEquatable<LossNotice>, INotice<LossNotice>
{
    private readonly NoticeStamp stamp;

    internal LossNotice(in EventKey key, in Vector3D position, in Vector3D velocity)
        : this(default, key, position, velocity)
    {
    }

    private LossNotice(in NoticeStamp stamp, in EventKey key, in Vector3D position, in Vector3D velocity)
    {
        this.stamp = stamp;
        Key = key;
        Position = position;
        Velocity = velocity;
    }

    /// <summary>Whether it is predicted, moved, in doubt, confirmed, retracted or unresolved.</summary>
    public NoticeKind Kind => stamp.Kind;

    /// <summary>
    /// Counts the notices of this peer from 1, lost ones included: a gap is one that found no room; see <see cref="LossNotices.Lost"/>.
    /// </summary>
    public long Number => stamp.Number;

    /// <summary>
    /// Which loss it is, the same in all notices of it: the <see cref="Number"/> of the one that predicted it. A late event may change its
    /// instant and all else but body and reason; this stays.
    /// </summary>
    public long Id => stamp.Id;

    /// <summary>The instant that was told before, where it was <see cref="NoticeKind.Moved"/>; otherwise <see cref="Time"/>.</summary>
    public SimTime MovedFrom => stamp.MovedFrom;

    /// <summary>The event, of the kind <see cref="EventKind.Lost"/>.</summary>
    public EventKey Key { get; }

    /// <summary>When the body leaves the world, in shared simulation time.</summary>
    public SimTime Time => Key.Time;

    /// <summary>The body. It is in the world no more; <see cref="Scene.Describe"/> names one of the scene's own.</summary>
    public BodyId Body => Key.Body;

    /// <summary>Why.</summary>
    public LossReason Reason => (LossReason)Key.Sequence;

    /// <summary>Where the body's centre was then, in m; zero if that is not a number.</summary>
    public Vector3D Position { get; }

    /// <summary>The velocity with which it could be followed no further, in m/s; zero if that is not a number.</summary>
    public Vector3D Velocity { get; }

    /// <summary>Whether it is the same loss, to the bit, whatever its kind.</summary>
    public bool IsSameLoss(in LossNotice other) => Key == other.Key && Position.Equals(other.Position) && Velocity.Equals(other.Velocity);

    /// <inheritdoc/>
    public bool Equals(LossNotice other) =>
        Kind == other.Kind && Number == other.Number && Id == other.Id && MovedFrom == other.MovedFrom && IsSameLoss(other);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is LossNotice other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Key.GetHashCode();

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in LossNotice a, in LossNotice b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in LossNotice a, in LossNotice b) => !a.Equals(b);

    /// <summary>Kind, body, reason, time, place and velocity, for logs.</summary>
    public override string ToString() => string.Format(
        CultureInfo.InvariantCulture, "{0}: body {1} is lost, {2}, at {3}, {4} m, {5} m/s", Kind, Body, Reason, Time.ToShortString(), Position, Velocity);

    int INotice<LossNotice>.CompareWith(LossNotice other) => EventKey.Compare(Key, other.Key);

    int INotice<LossNotice>.CompareSeries(LossNotice other)
    {
        int byBody = Body.CompareTo(other.Body);
        return byBody != 0 ? byBody : Reason.CompareTo(other.Reason);
    }

    bool INotice<LossNotice>.IsSameAs(LossNotice other) => IsSameLoss(other);

    LossNotice INotice<LossNotice>.As(in NoticeStamp stamp) => new(stamp, Key, Position, Velocity);
}
