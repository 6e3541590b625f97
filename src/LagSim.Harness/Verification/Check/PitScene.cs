using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>
/// A heap in a pit: 8 to 12 unequal balls with friction fall into it as a loose cloud, where players lift, kick and push them.
/// </summary>
/// <remarks>
/// Its contact tolerance is drawn too, so islands step at 64 Hz in some scenes and at 256 Hz in others. Actions end in time for the heap to
/// come to rest.
/// </remarks>
internal sealed class PitScene : CheckScene
{
    private static readonly double[] Frictions = [0, 0.2, 0.5, 1];
    private static readonly double[] Restitutions = [0, 0.2, 0.5, 0.9];

    private readonly SeededRandom random;
    private readonly double half;
    private readonly double tolerance;
    private readonly double friction;
    private readonly double rolling;
    private readonly double restitution;
    private readonly bool hasPeg;
    private readonly bool isForced;

    internal PitScene(SeededRandom random)
    {
        this.random = random;
        half = random.NextDouble(0.6, 1);
        tolerance = random.Pick(1e-2, 1e-3, 1e-3, 1e-4);
        friction = random.Pick(Frictions);
        rolling = random.Pick(0, 0.1, 0.3);
        restitution = random.Pick(Restitutions);
        hasPeg = random.IsLucky(25);
        isForced = random.IsLucky(25);
        int count = 8 + random.NextInt(5);
        for (int n = 0; n < count; n++)
        {
            Vector3D place = new(half * ((n % 2) - 0.5), 0.4 + (0.65 * (n / 4)), half * ((n / 2 % 2) - 0.5));
            Add(DrawSpec(), place + new Vector3D(random.NextDouble(-0.01, 0.01), 0, random.NextDouble(-0.01, 0.01)), Vector3D.Zero);
        }
    }

    internal override long? MaxEvents => 2_500;

    internal override double BusySeconds => 4;

    internal override int FewestHands => 1;

    /// <summary>Draws one of the two forces that let a heap rest: a drag, and one that slows a body turning across it.</summary>
    internal override BodySpec DrawSpec()
    {
        double radius = random.NextDouble(0.15, 0.29);
        ForceSet forces = isForced ? ForceSet.Of(random.Pick(1, 3)) : ForceSet.None;
        return new BodySpec(
            radius, radius * radius * radius * random.Pick(50, 50, 50, 500), restitution, forces: forces, tolerance: 1e-5, friction: friction, rollingResistance: rolling);
    }

    /// <summary>Draws a position above the heap, or in it.</summary>
    internal override Vector3D DrawPosition() => new(Across(), random.NextDouble(0.5, 2.5), Across());

    internal override Vector3D DrawSpin(in BodySpec spec) => DrawVelocity(20);

    internal override Vector3D DrawVelocity(double most) =>
        new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-1, 1), random.NextDouble(-1, 1)) * (most / 3);

    protected override void AddSurroundings(SceneBuilder builder)
    {
        builder.WithContactTolerance(tolerance).AddPlane("floor", Vector3D.Up, 0.0);
        AddWalls(builder, half, 5, 1); // a ceiling out of reach
        AddForces(builder, 2, Vector3D.Zero);
        if (hasPeg)
        {
            builder.AddStaticSphere("peg", Vector3D.Zero, 0.2);
        }
    }

    private double Across() => random.NextDouble(-1, 1) * (half - 0.3);
}
