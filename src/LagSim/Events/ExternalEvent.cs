using System;
using System.Globalization;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Events;

/// <summary>
/// An event that did not come from the model: a player's action on a body, or a word to the game's rules, stamped (time, peer, sequence) once
/// and for all.
/// </summary>
/// <remarks>
/// <para>An event for a body that is not there at its time has no effect. It may still get one if a late event puts the body there.</para>
/// <para>Immutable, safe on any thread. <c>default</c> is no event (<see cref="EventKind.None"/>) and is refused everywhere.</para>
/// </remarks>
public readonly struct ExternalEvent : IEquatable<ExternalEvent>
{
    private readonly object? told; // to rules: a GameCommand or a PlayerEvent

    private ExternalEvent(
        EventKind kind, SimTime time, byte peer, uint sequence, BodyId body, Vector3D position, Vector3D velocity, BodySpec spec, Vector3D spin = default,
        CollisionFilter filter = default, PeerSet players = default, WhenOccupied whenOccupied = default, object? told = null,
        double maxForce = 0, double maxPower = 0)
    {
        MaxForce = maxForce;
        MaxPower = maxPower;
        this.told = told;
        Kind = kind;
        Time = time;
        Peer = peer;
        Sequence = sequence;
        Body = body;
        Position = position;
        Velocity = velocity;
        Spec = spec;
        Spin = spin;
        Filter = filter;
        Players = players;
        WhenOccupied = whenOccupied;
    }

    /// <summary>The kind of the action.</summary>
    public EventKind Kind { get; }

    /// <summary>When, in shared simulation time.</summary>
    public SimTime Time { get; }

    /// <summary>The peer that did it.</summary>
    public byte Peer { get; }

    /// <summary>The number of the event at its peer, counted from 1.</summary>
    public uint Sequence { get; }

    /// <summary>
    /// The body it is done to. For what is done to none it is the identity of no body: (peer, sequence, 0) for a command, and (0, sequence,
    /// the player's number) for a <see cref="EventKind.Player"/>.
    /// </summary>
    public BodyId Body { get; }

    /// <summary>
    /// In metres. For a spawn or teleport, where the body's centre is put; for a keyframe, where the hand's point is; for a grab, that
    /// point less the body's centre; zero for any other.
    /// </summary>
    public Vector3D Position { get; }

    /// <summary>
    /// In metres per second for a spawn, teleport, set velocity, keyframe or release; in newton seconds for an impulse; zero for any other.
    /// </summary>
    public Vector3D Velocity { get; }

    /// <summary>The spec of a spawned body; <c>default</c> for any other event.</summary>
    public BodySpec Spec { get; }

    /// <summary>The spin of a spawned body, in radians per second about the vector; zero for any other event.</summary>
    public Vector3D Spin { get; }

    /// <summary>What the body collides with from now on, for a change of its filter; the default for any other event.</summary>
    public CollisionFilter Filter { get; }

    /// <summary>Which peers may do something to a spawned body; everyone for any other event.</summary>
    public PeerSet Players { get; }

    /// <summary>What becomes of a spawn or a teleport if something is there; the default for any other event.</summary>
    public WhenOccupied WhenOccupied { get; }

    /// <summary>The greatest force in N of a hand that grabs; 0 for the default, and for any other event.</summary>
    public double MaxForce { get; }

    /// <summary>The greatest power in W of a hand that grabs; 0 for the default, and for any other event.</summary>
    public double MaxPower { get; }

    /// <summary>What a <see cref="EventKind.Command"/> tells the game's rules; null for any other.</summary>
    public GameCommand? Command => told as GameCommand;

    /// <summary>What a <see cref="EventKind.Player"/> says of a player; null for any other.</summary>
    public PlayerEvent? PlayerEvent => told as PlayerEvent;

    /// <summary>Its place in the canonical order.</summary>
    public EventKey Key => new(Time, 0, Kind, Body, Body, Peer, Sequence);

    /// <summary>A new body appears; its identity is (<paramref name="peer"/>, <paramref name="sequence"/>, 0).</summary>
    internal static ExternalEvent Spawn(
        SimTime time, byte peer, uint sequence, BodySpec spec, Vector3D position, Vector3D velocity = default, Vector3D spin = default,
        PeerSet players = default, WhenOccupied whenOccupied = default) =>
        new(
            EventKind.Spawn, time, peer, sequence, new BodyId(peer, sequence, 0), position, velocity, spec, spin, players: players,
            whenOccupied: whenOccupied);

    /// <summary>The body disappears.</summary>
    internal static ExternalEvent Remove(SimTime time, byte peer, uint sequence, BodyId body) =>
        new(EventKind.Remove, time, peer, sequence, body, default, default, default);

    /// <summary>The body is put somewhere, with a velocity (default: none). It turns as it did.</summary>
    internal static ExternalEvent Teleport(
        SimTime time, byte peer, uint sequence, BodyId body, Vector3D position, Vector3D velocity = default,
        WhenOccupied whenOccupied = default) =>
        new(EventKind.Teleport, time, peer, sequence, body, position, velocity, default, whenOccupied: whenOccupied);

    /// <summary>The body's velocity becomes this. It turns as it did.</summary>
    internal static ExternalEvent SetVelocity(SimTime time, byte peer, uint sequence, BodyId body, Vector3D velocity) =>
        new(EventKind.SetVelocity, time, peer, sequence, body, default, velocity, default);

    /// <summary>
    /// The body's momentum changes by this many newton seconds, as of a push through its centre: it turns as it did. One that would make it
    /// faster than a tenth of the smallest radius in a tick (1.1e11 m/s times that radius in metres) has no effect, on every peer alike.
    /// What it meets is known only when its time comes: see <see cref="Simulation.TookEffect"/>.
    /// </summary>
    internal static ExternalEvent Impulse(SimTime time, byte peer, uint sequence, BodyId body, Vector3D impulse) =>
        new(EventKind.Impulse, time, peer, sequence, body, default, impulse, default);

    /// <summary>
    /// The peer's hand takes the body, by a point that lies <paramref name="offset"/> from its centre, in metres. Until the first keyframe
    /// the hand is assumed to be at rest where the body was. It does not get a body that is held already, or one that is faster than a
    /// player may make it. A held body does not turn, nor does it when it is released.
    /// </summary>
    internal static ExternalEvent Grab(
        SimTime time, byte peer, uint sequence, BodyId body, Vector3D offset = default, double maxForce = 0, double maxPower = 0) =>
        new(EventKind.Grab, time, peer, sequence, body, offset, default, default, maxForce: maxForce, maxPower: maxPower);

    /// <summary>
    /// The peer's hand, if it holds the body, is at a position (metres) with a velocity (m/s) now; see <see cref="Motion.HandPath"/> for
    /// what follows.
    /// </summary>
    internal static ExternalEvent HoldKeyframe(SimTime time, byte peer, uint sequence, BodyId body, Vector3D position, Vector3D velocity) =>
        new(EventKind.HoldKeyframe, time, peer, sequence, body, position, velocity, default);

    /// <summary>The peer's hand, if it holds the body, releases it. The body continues from where it is with this velocity (m/s).</summary>
    internal static ExternalEvent Release(SimTime time, byte peer, uint sequence, BodyId body, Vector3D velocity = default) =>
        new(EventKind.Release, time, peer, sequence, body, default, velocity, default);

    /// <summary>The body collides by this filter from now on. It moves on as it did, except where something carried it that it no longer
    /// collides with; one that is inside of static geometry that it collides with now is put outside of it, and keeps the filter that it has if
    /// there is no room.</summary>
    internal static ExternalEvent SetFilter(SimTime time, byte peer, uint sequence, BodyId body, CollisionFilter filter) =>
        new(EventKind.SetFilter, time, peer, sequence, body, default, default, default, filter: filter);

    /// <summary>The peer tells the game's rules something.</summary>
    internal static ExternalEvent Tell(SimTime time, byte peer, uint sequence, GameCommand command) =>
        new(EventKind.Command, time, peer, sequence, new BodyId(peer, sequence, 0), default, default, default, told: command);

    /// <summary>The host says something of a player to the game's rules.</summary>
    internal static ExternalEvent OfPlayer(SimTime time, uint sequence, PlayerEvent player) =>
        new(EventKind.Player, time, 0, sequence, new BodyId(0, sequence, player.Number), default, default, default, told: player);

    /// <summary>The same event at another time: how a strategy that does not heal applies a late event.</summary>
    public ExternalEvent At(SimTime time) =>
        new(Kind, time, Peer, Sequence, Body, Position, Velocity, Spec, Spin, Filter, Players, WhenOccupied, told, MaxForce, MaxPower);

    /// <inheritdoc/>
    public bool Equals(ExternalEvent other) =>
        Kind == other.Kind && Time == other.Time && Peer == other.Peer && Sequence == other.Sequence && Body == other.Body
        && Position.Equals(other.Position) && Velocity.Equals(other.Velocity) && Spec.Equals(other.Spec) && Spin.Equals(other.Spin)
        && Filter == other.Filter && Players == other.Players && WhenOccupied == other.WhenOccupied
        && MaxForce.Equals(other.MaxForce) && MaxPower.Equals(other.MaxPower)
        && Equals(told, other.told);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is ExternalEvent other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Time.GetHashCode() ^ ((int)Sequence * 397) ^ (Peer << 24);

    /// <summary>Kind, body, time and origin, for logs and error messages.</summary>
    public override string ToString() => told is not null
        ? string.Format(CultureInfo.InvariantCulture, "{0} at {1} by {2}.{3}", told, Time.ToShortString(), Peer, Sequence)
        : string.Format(CultureInfo.InvariantCulture, "{0} of body {1} at {2} by {3}.{4}", Kind, Body, Time.ToShortString(), Peer, Sequence);
}
