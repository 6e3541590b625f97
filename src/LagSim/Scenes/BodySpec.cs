using LagSim.Time;

namespace LagSim.Scenes;

/// <summary>The properties of a body, apart from its state: size, mass, material and how it flies.</summary>
/// <remarks>
/// Immutable, safe on any thread. Not valid as <c>default</c>: a radius and a mass are above zero. A scene and a simulation check it.
/// </remarks>
/// <example>
/// A football, in metres and kilograms:
/// <code>
/// BodySpec football = new(radius: 0.11, mass: 0.43, restitution: 0.7, friction: 0.6, rollingResistance: 0.02);
/// </code>
/// </example>
public readonly struct BodySpec : System.IEquatable<BodySpec>
{
    /// <summary>The step of <see cref="MotionLaw.RungeKutta4"/> where a scene names none: 1/200 s, as in the thesis.</summary>
    public static readonly SimDuration DefaultStep = SimDuration.FromSeconds(1.0 / 200.0);

    /// <summary>The tolerance where a scene names none: 1 nm, which is also what a scene resolves of bounces.</summary>
    public const double DefaultTolerance = 1e-9;

    /// <summary>A sphere of these properties.</summary>
    /// <param name="radius">Metres, 1e-9 to 1e9.</param>
    /// <param name="mass">Kilograms, 1e-30 to 1e30.</param>
    /// <param name="restitution">0 (stays) to 1 (elastic). Of two things that meet, the lesser counts.</param>
    /// <param name="flight">The law of free flight; by default <see cref="MotionLaw.Automatic"/>, the cheapest that is exact for the
    /// forces.</param>
    /// <param name="step">
    /// The step of an integrating law, 1 microsecond to 1 s; default <see cref="DefaultStep"/>. Ignored by closed forms and under error
    /// control.
    /// </param>
    /// <param name="forces">Those of the scene's forces that act on it besides gravity.</param>
    /// <param name="tolerance">
    /// 0 to 1. Of <see cref="MotionLaw.DormandPrince54"/> the estimated error that a step may have, in metres for the position and in m/s
    /// for the velocity; 0 means fixed steps. For <see cref="MotionLaw.ClosedForm"/> it is how far, in metres, the path may be off within a
    /// segment, which is exact at its ends; 0 means to rounding. Ignored by the others.
    /// </param>
    /// <param name="friction">
    /// The coefficient of Coulomb friction, 0 (none, the default) to 100. Of two things that meet, the lesser counts. Bodies are solid
    /// spheres: their moment of inertia is 2/5 m r².
    /// </param>
    /// <param name="rollingResistance">
    /// The coefficient of rolling resistance, 0 (rolls on, the default) to 1: the part of its weight that holds a rolling body back, and
    /// with as much of a moment one that turns on the spot. Counts for no more than the friction, without which nothing rolls.
    /// </param>
    /// <param name="filter">What it collides with, to begin with; default everything.</param>
    /// <param name="tag">64 bits of the game's own; default 0.</param>
    public BodySpec(
        double radius,
        double mass,
        double restitution,
        MotionLaw flight = MotionLaw.Automatic,
        SimDuration? step = null,
        ForceSet forces = default,
        double tolerance = DefaultTolerance,
        double friction = 0,
        double rollingResistance = 0,
        CollisionFilter filter = default,
        ulong tag = 0)
    {
        Radius = radius;
        Mass = mass;
        Restitution = restitution;
        Flight = flight == MotionLaw.Automatic && forces.IsEmpty ? MotionLaw.Ballistic : flight;
        Step = step ?? DefaultStep;
        Forces = forces;
        Tolerance = tolerance;
        Friction = friction;
        RollingResistance = rollingResistance;
        Filter = filter;
        Tag = tag;
    }

    /// <summary>The radius in metres.</summary>
    public double Radius { get; }

    /// <summary>The mass in kilograms.</summary>
    public double Mass { get; }

    /// <summary>The coefficient of restitution, 0 to 1.</summary>
    public double Restitution { get; }

    /// <summary>
    /// The law of free flight; <see cref="MotionLaw.Automatic"/> only with forces, until a scene or a simulation has chosen.
    /// </summary>
    public MotionLaw Flight { get; }

    /// <summary>
    /// The step of <see cref="MotionLaw.RungeKutta4"/>, and of <see cref="MotionLaw.DormandPrince54"/> with a tolerance of 0; others do not
    /// use it.
    /// </summary>
    public SimDuration Step { get; }

    /// <summary>The forces that act on it besides gravity.</summary>
    public ForceSet Forces { get; }

    /// <summary>
    /// The tolerance, in metres and m/s; 0 for fixed steps or, with a closed form, for rounding alone. See the constructor.
    /// </summary>
    public double Tolerance { get; }

    /// <summary>The coefficient of Coulomb friction, without a unit; of two things that meet, the lesser counts.</summary>
    public double Friction { get; }

    /// <summary>
    /// The coefficient of rolling resistance, without a unit: the body's own, but no more than the friction where it touches.
    /// </summary>
    public double RollingResistance { get; }

    /// <summary>
    /// What it collides with when it appears. A <see cref="Events.PlayerAction.SetFilter"/> changes that of the body, not this one:
    /// <see cref="BodyState.Filter"/> is what it has at an instant.
    /// </summary>
    public CollisionFilter Filter { get; }

    /// <summary>64 bits of the game's own, which mean nothing to the world: a kind, an owner, an index of a table.</summary>
    public ulong Tag { get; }

    /// <summary>The same body on another law of flight.</summary>
    /// <param name="flight">The law.</param>
    /// <param name="step">See the constructor; by default what it is.</param>
    /// <param name="tolerance">See the constructor; by default what it is.</param>
    public BodySpec With(MotionLaw flight, SimDuration? step = null, double? tolerance = null) =>
        new(Radius, Mass, Restitution, flight, step ?? Step, Forces, tolerance ?? Tolerance, Friction, RollingResistance, Filter, Tag);

    /// <summary>The same body with another filter to begin with.</summary>
    public BodySpec With(CollisionFilter filter) =>
        new(Radius, Mass, Restitution, Flight, Step, Forces, Tolerance, Friction, RollingResistance, filter, Tag);

    /// <summary>The same body with another tag.</summary>
    public BodySpec WithTag(ulong tag) =>
        new(Radius, Mass, Restitution, Flight, Step, Forces, Tolerance, Friction, RollingResistance, Filter, tag);

    /// <inheritdoc/>
    public bool Equals(BodySpec other) =>
        Radius.Equals(other.Radius) && Mass.Equals(other.Mass) && Restitution.Equals(other.Restitution)
        && Flight == other.Flight && Step == other.Step && Forces == other.Forces && Tolerance.Equals(other.Tolerance)
        && Friction.Equals(other.Friction) && RollingResistance.Equals(other.RollingResistance)
        && Filter == other.Filter && Tag == other.Tag;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is BodySpec other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Radius.GetHashCode() ^ (Mass.GetHashCode() * 397) ^ (Restitution.GetHashCode() * 7919);
}
