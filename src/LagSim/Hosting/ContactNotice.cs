using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Hosting;

/// <summary>
/// A contact: a body meets another, or a surface of the scene. It has what a game needs for a sound or a score.
/// </summary>
/// <remarks>
/// Immutable, safe on any thread. The data of the contact has the same bits on every peer. <see cref="Number"/>, and which contacts come as
/// predicted, are each peer's own.
/// </remarks>
public readonly struct ContactNotice : IEquatable<ContactNotice>, INotice<ContactNotice>
{
    private readonly NoticeStamp stamp;

    internal ContactNotice(in EventKey key, in ImpactContact contact)
    {
        stamp = default;
        Key = key;
        First = contact.First;
        Second = contact.Second;
        Surface = contact.Surface;
        Position = contact.Position;
        ClosingSpeed = contact.ClosingSpeed;
    }

    private ContactNotice(in NoticeStamp stamp, in ContactNotice of)
    {
        this = of;
        this.stamp = stamp;
    }

    /// <summary>Whether it is predicted, moved, in doubt, confirmed, retracted or unresolved.</summary>
    public NoticeKind Kind => stamp.Kind;

    /// <summary>
    /// Counts the notices of this peer from 1, lost ones included: a gap is one that found no room; see <see cref="ContactNotices.Lost"/>.
    /// </summary>
    public long Number => stamp.Number;

    /// <summary>
    /// Which contact it is, the same in all notices of it: the <see cref="Number"/> of the one that predicted it. A late event may change its
    /// instant and all else; this stays.
    /// </summary>
    public long Id => stamp.Id;

    /// <summary>The instant that was told before, where it was <see cref="NoticeKind.Moved"/>; otherwise <see cref="Time"/>.</summary>
    public SimTime MovedFrom => stamp.MovedFrom;

    /// <summary>The impact. All contacts of one tick and round that share bodies are one impact, and so have one key.</summary>
    public EventKey Key { get; }

    /// <summary>When it happens, in shared simulation time.</summary>
    public SimTime Time => Key.Time;

    /// <summary>The body; of two the one of lesser identity.</summary>
    public BodyId First { get; }

    /// <summary>The other body; <see cref="First"/> again where it met a surface.</summary>
    public BodyId Second { get; }

    /// <summary>
    /// The surface that it met. Below the number of <see cref="Scene.Planes"/> it is the index of a plane; from there on the rest is the
    /// index of a static sphere; -1 where two bodies met.
    /// </summary>
    public int Surface { get; }

    /// <summary>Where they touch, in metres.</summary>
    public Vector3D Position { get; }

    /// <summary>
    /// How fast they approach along their normal right before, in m/s, above zero. With the masses it gives the strength of the impact.
    /// </summary>
    public double ClosingSpeed { get; }

    /// <summary>The name of the surface in its scene; empty where two bodies met.</summary>
    /// <exception cref="ArgumentException">The scene has no such surface: it is another one.</exception>
    public string SurfaceName(Scene scene)
    {
        if (scene is null)
        {
            throw new ArgumentNullException(nameof(scene));
        }

        int sphere = Surface - scene.Planes.Count;
        return Surface < 0 ? ""
            : sphere < 0 ? scene.Planes[Surface].Name
            : sphere < scene.StaticSpheres.Count ? scene.StaticSpheres[sphere].Name
            : throw new ArgumentException($"The contact is with surface {Surface}; this scene has"
                + $" {scene.Planes.Count + scene.StaticSpheres.Count}.", nameof(scene));
    }

    /// <summary>Whether it is about the same contact, to the bit, whatever its kind.</summary>
    public bool IsSameContact(in ContactNotice other) =>
        Compare(this, other) == 0 && Position.Equals(other.Position) && ClosingSpeed.Equals(other.ClosingSpeed);

    /// <inheritdoc/>
    public bool Equals(ContactNotice other) =>
        Kind == other.Kind && Number == other.Number && Id == other.Id && MovedFrom == other.MovedFrom && IsSameContact(other);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is ContactNotice other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Key.GetHashCode() ^ (First.GetHashCode() * 397) ^ (Second.GetHashCode() * 31) ^ Surface;

    /// <summary>Same in every part.</summary>
    public static bool operator ==(in ContactNotice a, in ContactNotice b) => a.Equals(b);

    /// <summary>Different in some part.</summary>
    public static bool operator !=(in ContactNotice a, in ContactNotice b) => !a.Equals(b);

    /// <summary>Kind, bodies, time, place and speed, for logs.</summary>
    public override string ToString() => string.Format(
        CultureInfo.InvariantCulture, "{0} {1}/{2} at {3}, {4} m, {5} m/s",
            Kind, First, Surface < 0 ? Second.ToString() : $"surface {Surface}", Time.ToShortString(), Position, ClosingSpeed);

    /// <summary>The order of contacts: by impact, then by bodies and surface.</summary>
    internal static int Compare(in ContactNotice a, in ContactNotice b)
    {
        int byKey = EventKey.Compare(a.Key, b.Key);
        int byFirst = byKey != 0 ? byKey : a.First.CompareTo(b.First);
        int bySecond = byFirst != 0 ? byFirst : a.Second.CompareTo(b.Second);
        return bySecond != 0 ? bySecond : a.Surface.CompareTo(b.Surface);
    }

    int INotice<ContactNotice>.CompareWith(ContactNotice other) => Compare(this, other);

    int INotice<ContactNotice>.CompareSeries(ContactNotice other)
    {
        int byFirst = First.CompareTo(other.First);
        int bySecond = byFirst != 0 ? byFirst : Second.CompareTo(other.Second);
        return bySecond != 0 ? bySecond : Surface.CompareTo(other.Surface);
    }

    bool INotice<ContactNotice>.IsSameAs(ContactNotice other) => IsSameContact(other);

    ContactNotice INotice<ContactNotice>.As(in NoticeStamp stamp) => new(stamp, this);
}
