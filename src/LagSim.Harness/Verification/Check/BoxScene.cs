using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>A random gas in a periodic box, with 8 to 12 balls.</summary>
/// <remarks>
/// Such a box allows no gravity, force or wall. Without static geometry, a change spreads only through balls.
/// </remarks>
internal sealed class BoxScene : CheckScene
{
    private static readonly double[] Restitutions = [0.5, 0.8, 0.9, 1, 1];
    private static readonly double[] Masses = [0.5, 1, 1, 1, 3, 20];

    private readonly SeededRandom random;
    private readonly Vector3D size;
    private readonly double roughPercent;
    private readonly double[] restitutions;

    internal BoxScene(SeededRandom random)
    {
        this.random = random;
        size = new Vector3D(random.NextDouble(3, 4), random.NextDouble(3, 4), random.NextDouble(3, 4)); // five diameters at least
        roughPercent = random.IsLucky(30) ? 70 : 0;
        restitutions = random.IsLucky(30) ? Restitutions : [0.9, 1, 1];
        int count = 8 + random.NextInt(5);
        double fastest = random.Pick(3.0, 6, 9);
        for (int i = 0; i < count; i++)
        {
            // On a grid, so that no ball overlaps another or its image; the first few are across the box's edges.
            Vector3D position = new(0.1 + (0.75 * (i % 4)), 0.1 + (0.75 * (i / 4)), random.NextDouble(0, 3));
            Add(DrawSpec(), position, DrawVelocity(fastest));
        }
    }

    /// <summary>There are no holds in a periodic box.</summary>
    internal override int MaxHands => 0;

    internal override BodySpec DrawSpec() => new(
        random.Pick(0.2, 0.2, 0.25, 0.3), random.Pick(Masses), random.Pick(restitutions),
        friction: random.IsLucky(roughPercent) ? random.Pick(0.1, 0.4, 1) : 0);

    internal override Vector3D DrawPosition() => new(random.NextDouble(0, 1) * size.X, random.NextDouble(0, 1) * size.Y, random.NextDouble(0, 1) * size.Z);

    internal override Vector3D DrawSpin(in BodySpec spec) => MayTurn(spec) ? DrawVelocity(20) : Vector3D.Zero;

    internal override Vector3D DrawVelocity(double most) =>
        new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-1, 1), random.NextDouble(-1, 1)) * most;

    protected override void AddSurroundings(SceneBuilder builder) => builder.WithGravity(Vector3D.Zero).WithPeriodicBox(size);
}
