using LagSim.Time;

namespace LagSim.Scenes;

/// <summary>What a body is, apart from where it is: size, mass, material and how it flies.</summary>
/// <remarks>Immutable, safe on any thread. Not valid as <c>default</c>: a radius and a mass are above zero. A scene and a simulation check it.</remarks>
public readonly struct BodySpec : System.IEquatable<BodySpec>
{
    /// <summary>The step of <see cref="MotionLaw.RungeKutta4"/> where a scene names none: 1/200 s, as in the thesis.</summary>
    public static readonly SimDuration DefaultStep = SimDuration.FromSeconds(1.0 / 200.0);

    /// <summary>A sphere of these properties.</summary>
    /// <param name="radius">Metres, 1e-9 to 1e9.</param>
    /// <param name="mass">Kilograms, 1e-30 to 1e30.</param>
    /// <param name="restitution">0 (stays) to 1 (elastic). Of two things that meet, the lesser counts.</param>
    /// <param name="flight">The law of free flight: <see cref="MotionLaw.Ballistic"/> or <see cref="MotionLaw.RungeKutta4"/>.</param>
    /// <param name="step">The step of an integrating law, 1 microsecond to 1 s; zero means <see cref="DefaultStep"/>. Ignored by closed forms.</param>
    /// <param name="acceleration">0: gravity alone; n: gravity and the scene's n-th supplied acceleration, which needs an integrating law.</param>
    public BodySpec(
        double radius, double mass, double restitution, MotionLaw flight = MotionLaw.Ballistic, SimDuration step = default, byte acceleration = 0)
    {
        Radius = radius;
        Mass = mass;
        Restitution = restitution;
        Flight = flight;
        Step = step == SimDuration.Zero ? DefaultStep : step;
        Acceleration = acceleration;
    }

    /// <summary>The radius in metres.</summary>
    public double Radius { get; }

    /// <summary>The mass in kilograms.</summary>
    public double Mass { get; }

    /// <summary>The coefficient of restitution, 0 to 1.</summary>
    public double Restitution { get; }

    /// <summary>The law of free flight.</summary>
    public MotionLaw Flight { get; }

    /// <summary>The integrator's step.</summary>
    public SimDuration Step { get; }

    /// <summary>0, or the number of the scene's supplied acceleration that acts besides gravity.</summary>
    public byte Acceleration { get; }

    /// <inheritdoc/>
    public bool Equals(BodySpec other) =>
        Radius.Equals(other.Radius) && Mass.Equals(other.Mass) && Restitution.Equals(other.Restitution)
        && Flight == other.Flight && Step == other.Step && Acceleration == other.Acceleration;

    /// <inheritdoc/>
    public override bool Equals(object? obj) => obj is BodySpec other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => Radius.GetHashCode() ^ (Mass.GetHashCode() * 397) ^ (Restitution.GetHashCode() * 7919);
}
