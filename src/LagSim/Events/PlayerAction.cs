using System;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Events;

/// <summary>
/// A player's action on a body, or a command to the game's rules, before it is stamped with time, peer and sequence and so becomes an <see cref="ExternalEvent"/>.
/// </summary>
/// <remarks>Immutable, safe on any thread. <c>default</c> is no action and cannot be stamped.</remarks>
/// <example>
/// A kick, then a ball that is put elsewhere at rest:
/// <code>
/// _ = me.Do(PlayerAction.Impulse(ball, new Vector3D(0, 6, 0))); // 6 N s upwards
/// _ = me.Do(PlayerAction.Teleport(ball, new Vector3D(0, 4, 0), Vector3D.Zero));
/// </code>
/// </example>
public readonly struct PlayerAction
{
    private readonly BodyId body;
    private readonly Vector3D position;
    private readonly Vector3D velocity;
    private readonly BodySpec spec;
    private readonly Vector3D spin;
    private readonly CollisionFilter filter;
    private readonly PeerSet players;
    private readonly WhenOccupied whenOccupied;
    private readonly double maxForce;
    private readonly double maxPower;

    private readonly GameCommand? command;

    private PlayerAction(
        EventKind kind, BodyId body, Vector3D position, Vector3D velocity, BodySpec spec, Vector3D spin = default,
        CollisionFilter filter = default, PeerSet players = default, WhenOccupied whenOccupied = default, double maxForce = 0, double maxPower = 0)
    {
        this.maxForce = maxForce;
        this.maxPower = maxPower;
        command = null;
        Kind = kind;
        this.body = body;
        this.position = position;
        this.velocity = velocity;
        this.spec = spec;
        this.spin = spin;
        this.filter = filter;
        this.players = players;
        this.whenOccupied = whenOccupied;
    }

    private PlayerAction(GameCommand command)
        : this(EventKind.Command, default, default, default, default) => this.command = command;

    /// <summary>The kind of the action; <see cref="EventKind.None"/> for the default.</summary>
    public EventKind Kind { get; }

    /// <summary>
    /// A new body appears, at metres, with metres per second, and turning by radians per second about <paramref name="spin"/> (default:
    /// not). Its identity comes with the stamp.
    /// </summary>
    /// <param name="spec">Size, mass, material, flight, filter and tag.</param>
    /// <param name="position">Where its centre is put, in metres.</param>
    /// <param name="velocity">In m/s; default none.</param>
    /// <param name="spin">In rad/s about the vector; default none.</param>
    /// <param name="players">Which peers may do something to it; default everyone. What any other does to it has no effect, on every peer alike;
    /// only the host may remove it all the same.</param>
    /// <param name="whenOccupied">What becomes of it if another body or static geometry that it collides with is there at that instant; by default
    /// it is put into a body all the same, and outside of a wall.</param>
    public static PlayerAction Spawn(
        BodySpec spec, Vector3D position, Vector3D velocity = default, Vector3D spin = default, PeerSet players = default,
        WhenOccupied whenOccupied = WhenOccupied.Overlap) =>
        new(EventKind.Spawn, default, position, velocity, spec, spin, players: players, whenOccupied: whenOccupied);

    /// <summary>The body disappears.</summary>
    public static PlayerAction Remove(BodyId body) => new(EventKind.Remove, body, default, default, default);

    /// <summary>The body is put somewhere (metres), with a velocity (m/s; default: none). It turns as it did.</summary>
    /// <param name="body">The body.</param>
    /// <param name="position">Where its centre is put, in metres.</param>
    /// <param name="velocity">In m/s; default none.</param>
    /// <param name="whenOccupied">What becomes of it if another body or static geometry that it collides with is there at that instant; by default
    /// it is put into a body all the same, and outside of a wall.</param>
    public static PlayerAction Teleport(
        BodyId body, Vector3D position, Vector3D velocity = default, WhenOccupied whenOccupied = WhenOccupied.Overlap) =>
        new(EventKind.Teleport, body, position, velocity, default, whenOccupied: whenOccupied);

    /// <summary>The body's velocity becomes this, in m/s. It turns as it did.</summary>
    public static PlayerAction SetVelocity(BodyId body, Vector3D velocity) => new(EventKind.SetVelocity, body, default, velocity, default);

    /// <summary>
    /// The body's momentum changes by this many newton seconds, as of a push through its centre: it turns as it did. One that would make it
    /// faster than a tenth of the smallest radius in a tick (1.1e11 m/s times that radius in metres) has no effect, on every peer alike.
    /// What it meets is known only when its time comes: see <see cref="Simulation.TookEffect"/>.
    /// </summary>
    public static PlayerAction Impulse(BodyId body, Vector3D impulse) => new(EventKind.Impulse, body, default, impulse, default);

    /// <summary>
    /// The player's hand takes the body, by a point that lies <paramref name="offset"/> (metres) from its centre. The hold lasts while the
    /// hand sends keyframes, a second after each; see <see cref="Motion.HandPath"/>. Until the first one the hand is assumed to be at rest
    /// where the body was. A body that is held already, or faster than a player may make it, is not taken. A held body does not turn, nor
    /// does it when it is released.
    /// </summary>
    /// <param name="body">The body.</param>
    /// <param name="offset">From its centre to the hand's point, in metres; default none.</param>
    /// <param name="maxForce">The greatest force in N with which it pushes what it meets, above 0 and up to 1e30. By default 1000 N, and 1000 N
    /// more for each kg of the body (<see cref="Motion.HandStrength"/>). What would take more force, it goes through. A host may refuse a grab that asks for
    /// more than it allows.</param>
    /// <param name="maxPower">Its greatest power in W, above 0 and up to 1e30. By default what its greatest force gives at 50 m/s.</param>
    public static PlayerAction Grab(BodyId body, Vector3D offset = default, double maxForce = 0, double maxPower = 0) =>
        new(EventKind.Grab, body, offset, default, default, maxForce: maxForce, maxPower: maxPower);

    /// <summary>The hand that holds the body is at a position (metres) with a velocity (m/s).</summary>
    public static PlayerAction HoldKeyframe(BodyId body, Vector3D position, Vector3D velocity) => new(EventKind.HoldKeyframe, body, position, velocity, default);

    /// <summary>The hand that holds the body releases it. The body continues with this velocity (m/s).</summary>
    public static PlayerAction Release(BodyId body, Vector3D velocity = default) => new(EventKind.Release, body, default, velocity, default);

    /// <summary>The player tells the game's rules something (<see cref="Rules.GameRules.OnCommand"/>). For scenes that have rules.</summary>
    /// <exception cref="ArgumentNullException">There is no command.</exception>
    public static PlayerAction Command(GameCommand command) => new(command ?? throw new ArgumentNullException(nameof(command)));

    /// <summary>
    /// The body collides by this filter from now on. It moves on as it did, except where something carried it that it no longer collides
    /// with. If it is inside of a plane or static sphere that it collides with now, it is put outside of it, and where there is no
    /// room outside it keeps the filter that it has; two bodies inside of each other are pushed apart. A body that has the filter already is not touched.
    /// </summary>
    public static PlayerAction SetFilter(BodyId body, CollisionFilter filter) =>
        new(EventKind.SetFilter, body, default, default, default, filter: filter);

    /// <summary>
    /// The event that this action is, done by <paramref name="peer"/> at <paramref name="time"/> as its <paramref name="sequence"/>-th.
    /// </summary>
    /// <exception cref="InvalidOperationException">This is <c>default</c>, no action.</exception>
    public ExternalEvent Stamp(SimTime time, byte peer, uint sequence) => Kind switch
    {
        EventKind.Spawn => ExternalEvent.Spawn(time, peer, sequence, spec, position, velocity, spin, players, whenOccupied),
        EventKind.Remove => ExternalEvent.Remove(time, peer, sequence, body),
        EventKind.Teleport => ExternalEvent.Teleport(time, peer, sequence, body, position, velocity, whenOccupied),
        EventKind.SetVelocity => ExternalEvent.SetVelocity(time, peer, sequence, body, velocity),
        EventKind.Impulse => ExternalEvent.Impulse(time, peer, sequence, body, velocity),
        EventKind.Grab => ExternalEvent.Grab(time, peer, sequence, body, position, maxForce, maxPower),
        EventKind.HoldKeyframe => ExternalEvent.HoldKeyframe(time, peer, sequence, body, position, velocity),
        EventKind.Release => ExternalEvent.Release(time, peer, sequence, body, velocity),
        EventKind.Command => ExternalEvent.Tell(time, peer, sequence, command!),
        EventKind.SetFilter => ExternalEvent.SetFilter(time, peer, sequence, body, filter),
        _ => throw new InvalidOperationException("The default PlayerAction is no action."),
    };

    /// <summary>
    /// The kind and the body, such as <c>Grab of body 0.0.3</c>; the kind alone for a spawn, whose body gets its identity later.
    /// </summary>
    public override string ToString() => command is not null ? command.ToString() : Kind is EventKind.None or EventKind.Spawn ? Kind.ToString() : $"{Kind} of body {body}";
}
