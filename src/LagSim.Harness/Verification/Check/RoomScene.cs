using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;

namespace LagSim.Harness.Verification.Check;

/// <summary>A random scene: a closed room in which 8 to 12 balls meet each other all the time.</summary>
/// <remarks>
/// With and without gravity, often flat, with any restitution and mass ratio, on any motion law under any of the forces, with and without
/// friction, sometimes around static spheres. Some are calm: falling balls come to rest within a second or two, until something happens to
/// them, so late events also reach bodies that are at rest by then.
/// </remarks>
internal sealed class RoomScene : CheckScene
{
    private static readonly double[] Restitutions = [0, 0.3, 0.5, 0.8, 0.9, 1, 1];
    private static readonly double[] CalmRestitutions = [0, 0, 0.3, 0.5];
    private static readonly double[] Masses = [0.5, 1, 1, 1, 3, 20];
    private static readonly double[] ExtremeMasses = [1e-6, 1e-2, 1, 1, 1e3, 1e9];

    private readonly SeededRandom random;
    private readonly SeededRandom flights; // a stream of its own, so that flight laws change nothing else that is drawn
    private readonly SeededRandom spins;
    private readonly int forcedPercent;
    private readonly int roughPercent;
    private readonly double rolling;
    private readonly Vector3D wind;
    private readonly double[] masses;
    private readonly double[] restitutions;
    private readonly double half;
    private readonly bool isCalm;
    private readonly bool isFlat;
    private readonly int integratedPercent;
    private readonly bool hasForce;
    private readonly bool hasGravity;
    private readonly bool hasDome;
    private readonly double wall;
    private readonly double floor;

    internal RoomScene(SeededRandom random)
    {
        this.random = random;
        flights = random.Fork(1);
        spins = random.Fork(2);
        wind = DrawWind(random.Fork(3));
        bool isForced = flights.IsLucky(45);
        roughPercent = flights.IsLucky(30) ? 70 : 0;
        rolling = flights.Pick(0, 0.01, 0.05);
        masses = random.IsLucky(20) ? ExtremeMasses : Masses;
        isCalm = random.IsLucky(10);
        hasGravity = random.IsLucky(35) || isCalm;
        forcedPercent = !isForced ? 0 : hasGravity ? 15 : 30; // a ball at rest on a floor under a force takes five hundred steps a second
        // Falling balls that lose speed pile up.
        restitutions = isCalm ? CalmRestitutions : random.IsLucky(hasGravity ? 85 : 30) ? [0.9, 1, 1] : Restitutions;
        half = random.NextDouble(1.6, 2.1);
        isFlat = random.IsLucky(60) && !isCalm; // they would lie on top of each other
        integratedPercent = random.IsLucky(20) ? 12 : 0;
        hasForce = random.IsLucky(40);
        hasDome = random.IsLucky(30);
        wall = isCalm ? 0 : random.Pick(restitutions); // there is no friction: only a wall stops a ball that slides along the floor
        floor = random.Pick(restitutions);
        int count = 8 + random.NextInt(5);
        double fastest = random.Pick(3.0, 6, 9);
        for (int i = 0; i < count; i++)
        {
            // On a grid, so that no balls overlap; four in a row, the first row above the dome.
            Vector3D position = new((0.75 * (i % 4)) - 1.125, 1 + (0.75 * (i / 4)), isFlat ? 0 : random.NextDouble(-1, 1));
            Add(DrawSpec(), position, DrawVelocity(fastest));
        }
    }

    /// <summary>
    /// Less where falling balls come to rest. With more activity there, balls come to lie on each other, which decides when actions happen.
    /// </summary>
    internal override long? MaxEvents => isCalm ? 400 : null;

    internal override int MaxHands => isCalm ? 0 : base.MaxHands;

    protected override void AddSurroundings(SceneBuilder builder)
    {
        AddWalls(builder.AddPlane("floor", Vector3D.Up, Vector3D.Zero, floor), half, half, wall);
        AddForces(builder, half, wind);
        if (!hasGravity)
        {
            builder.WithGravity(Vector3D.Zero);
        }

        if (hasDome)
        {
            builder.AddStaticSphere("dome", new Vector3D(0.3, -0.6, 0), 1, wall);
        }
    }

    internal override BodySpec DrawSpec()
    {
        bool isIntegrated = random.IsLucky(integratedPercent);
        BodySpec spec = new(
            random.Pick(0.2, 0.2, 0.25, 0.3), random.Pick(masses), random.Pick(restitutions), isIntegrated ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic,
            isIntegrated ? SimDuration.FromSeconds(random.Pick(0.03125, 0.05)) : null, isIntegrated && hasForce ? ForceSet.Of(0) : ForceSet.None);
        return masses != Masses ? spec : flights.IsLucky(forcedPercent) ? Forced(spec) : flights.IsLucky(roughPercent) ? Rough(spec) : spec;
    }

    /// <summary>Returns the same ball with friction.</summary>
    private BodySpec Rough(in BodySpec spec) => new(
        spec.Radius, spec.Mass, spec.Restitution, spec.Flight, spec.Step, spec.Forces, spec.Tolerance, flights.Pick(0.1, 0.4, 1), rolling);

    /// <summary>
    /// Returns the same ball under any of the forces, with and without friction, by the law that the world picks for them, or another.
    /// </summary>
    private BodySpec Forced(in BodySpec spec)
    {
        ForceSet set = ForceSet.None;
        while (set.IsEmpty)
        {
            bool isLinear = flights.IsLucky(50); // then there is a closed form
            for (int n = isLinear ? 1 : 0; n <= (isLinear ? 3 : Magnus); n++)
            {
                set |= flights.IsLucky(40) ? ForceSet.Of(n) : ForceSet.None;
            }
        }

        MotionLaw law = flights.Pick(MotionLaw.Automatic, MotionLaw.Automatic, MotionLaw.Automatic, MotionLaw.RungeKutta4, MotionLaw.DormandPrince54);
        double tolerance = law == MotionLaw.DormandPrince54 ? flights.Pick(1e-3, 1e-5, 0) : flights.Pick(1e-3, 1e-5); // 0 for fixed steps
        double friction = flights.IsLucky(roughPercent) ? 0.3 : 0;
        return new BodySpec(
            spec.Radius, spec.Mass, spec.Restitution, law, SimDuration.FromSeconds(flights.Pick(0.03125, 0.05)), set, tolerance, friction,
            friction > 0 ? rolling : 0);
    }

    internal override Vector3D DrawPosition() => new(
        random.NextDouble(-1, 1) * (half - 0.3), random.NextDouble(0.7, (2 * half) - 0.3), isFlat ? 0 : random.NextDouble(-1, 1) * (half - 0.3));

    /// <summary>Draws any ball, most often one to which it makes a difference.</summary>
    internal override Vector3D DrawSpin(in BodySpec spec) => MayTurn(spec) && spins.IsLucky(75)
        ? new Vector3D(spins.NextDouble(-1, 1), spins.NextDouble(-1, 1), spins.NextDouble(-1, 1)) * 20
        : Vector3D.Zero;

    /// <summary>Up to a given size along each axis. In a calm room mostly straight up or down, so that the ball can come to rest.</summary>
    internal override Vector3D DrawVelocity(double most) => isCalm && random.IsLucky(75)
        ? new(0, random.NextDouble(-1, 1) * most, 0)
        : new(random.NextDouble(-1, 1) * most, random.NextDouble(-1, 1) * most, isFlat ? 0 : random.NextDouble(-1, 1) * most);
}
