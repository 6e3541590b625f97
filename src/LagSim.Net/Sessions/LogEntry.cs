using System;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;

namespace LagSim.Net.Sessions;

/// <summary>An entry of the host's log: an event and the host's verdict on it.</summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is no entry.</remarks>
public readonly struct LogEntry : IEquatable<LogEntry>
{
    /// <summary>Creates an entry.</summary>
    public LogEntry(uint index, Verdict verdict, in ExternalEvent what)
    {
        Index = index;
        Verdict = verdict;
        Event = what;
    }

    /// <summary>Its place in the log, counted from 1.</summary>
    public uint Index { get; }

    /// <summary>The host's verdict.</summary>
    public Verdict Verdict { get; }

    /// <summary>Whether the event happened, on every peer: <see cref="Verdict.Accepted"/> or <see cref="Verdict.Moved"/>.</summary>
    public bool IsAccepted => Verdict.IsAcceptance();

    /// <summary>The event, at the time at which it happened; if it was refused, at which its author stamped it.</summary>
    public ExternalEvent Event { get; }

    /// <inheritdoc/>
    public bool Equals(LogEntry other) => Index == other.Index && Verdict == other.Verdict && Event.Equals(other.Event);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is LogEntry other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Event.GetHashCode() ^ ((int)Index * 397);

    /// <summary>The verdict and every value of the event, with all digits: different entries of one index have different texts.</summary>
    public override string ToString()
    {
        BodySpec spec = Event.Spec;
        string values = Event.Kind switch
        {
            EventKind.Spawn => FormattableString.Invariant(
                $": radius {spec.Radius:R} m, mass {spec.Mass:R} kg, restitution {spec.Restitution:R}, {spec.Flight}")
                + $" with a step of {spec.Step.ToShortString()},"
                + FormattableString.Invariant($" a tolerance of {spec.Tolerance:R}, forces {spec.Forces}, friction {spec.Friction:R} and rolling resistance {spec.RollingResistance:R}, {spec.Filter}, tag {spec.Tag},")
                + $" at {Event.Position} m with {Event.Velocity} m/s and {Event.Spin} rad/s" + Belongs() + Occupied(),
            EventKind.Teleport => $": to {Event.Position} m with {Event.Velocity} m/s" + Occupied(),
            EventKind.SetVelocity => $": to {Event.Velocity} m/s",
            EventKind.Impulse => $": of {Event.Velocity} N s",
            EventKind.Grab => $": by the point {Event.Position} m from its centre" + Strength(),
            EventKind.HoldKeyframe => $": the hand at {Event.Position} m with {Event.Velocity} m/s",
            EventKind.Release => $": with {Event.Velocity} m/s",
            EventKind.SetFilter => $": to {Event.Filter}",
            _ => "",
        };
        return $"{Verdict}: {Event}{values}";
    }

    private string Belongs() => Event.Players == PeerSet.Everyone ? "" : $", for {Event.Players} alone";

    private string Strength() => (Event.MaxForce == 0 ? "" : FormattableString.Invariant($", with {Event.MaxForce:R} N at most"))
        + (Event.MaxPower == 0 ? "" : FormattableString.Invariant($", with {Event.MaxPower:R} W at most"));

    private string Occupied() => Event.WhenOccupied == WhenOccupied.Overlap ? "" : $", {Event.WhenOccupied} if something is there";
}
