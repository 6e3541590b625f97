using System;
using System.Globalization;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Timelines;

/// <summary>A crossing: a body enters or leaves a sensor.</summary>
/// <remarks>Immutable, safe on any thread. It has the same bits on every peer.</remarks>
public readonly struct Crossing : IEquatable<Crossing>
{
    /// <summary>The crossing of an event's key.</summary>
    /// <param name="key">The key of an event of the kind <see cref="EventKind.Crossing"/>; its sequence is the index of the sensor.</param>
    /// <param name="entered">Whether the body enters; if not, it leaves.</param>
    /// <exception cref="ArgumentException">The key is of another kind.</exception>
    public Crossing(in EventKey key, bool entered)
    {
        Key = key.Kind == EventKind.Crossing
            ? key
            : throw new ArgumentException($"The key of a crossing is of the kind {EventKind.Crossing}; this one is {key}.", nameof(key));
        Entered = entered;
    }

    /// <summary>Its place in the canonical order.</summary>
    public EventKey Key { get; }

    /// <summary>Whether the body enters; if not, it leaves.</summary>
    public bool Entered { get; }

    /// <summary>When, in simulated time: the root of the distance to the boundary, to the nearest tick.</summary>
    public SimTime Time => Key.Time;

    /// <summary>The body that crosses.</summary>
    public BodyId Body => Key.Body;

    /// <summary>The index of the sensor in <see cref="Scene.Sensors"/>.</summary>
    public int Sensor => unchecked((int)Key.Sequence);

    /// <inheritdoc/>
    public bool Equals(Crossing other) => Key == other.Key && Entered == other.Entered;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is Crossing other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Key.GetHashCode() ^ (Entered ? 1 : 0);

    /// <summary>The same crossing.</summary>
    public static bool operator ==(in Crossing a, in Crossing b) => a.Equals(b);

    /// <summary>Another crossing.</summary>
    public static bool operator !=(in Crossing a, in Crossing b) => !a.Equals(b);

    /// <summary>Body, sensor and time, for logs.</summary>
    public override string ToString() => string.Format(
        CultureInfo.InvariantCulture, "body {0} {1} sensor {2} at {3} round {4}", Body, Entered ? "enters" : "leaves", Sensor, Time.ToShortString(), Key.Round);
}
