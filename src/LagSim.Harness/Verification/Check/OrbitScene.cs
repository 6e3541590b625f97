using System;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Check;

/// <summary>Random balls on orbits around an attracting static sphere, in a closed room of 5 m without gravity.</summary>
/// <remarks>
/// Most are attracted by the inverse square and fly by the closed form of Kepler's problem, until they meet each other, a wall or the
/// sphere, on which slow balls come to rest. Others are attracted by another power, or through a wind as well. So contact lasts on a round
/// surface, under a force, with and without rolling resistance.
/// </remarks>
internal sealed class OrbitScene : CheckScene
{
    private const double Half = 2.5;
    private const double Sun = 0.3; // metres, its radius

    private readonly SeededRandom random;
    private readonly double strength;
    private readonly int power;
    private readonly double friction;
    private readonly double rolling;
    private readonly double bounce;
    private readonly Vector3D wind;

    internal OrbitScene(SeededRandom random)
    {
        this.random = random;
        strength = random.NextDouble(4, 12);
        power = random.Pick(-1, -1, -3);
        friction = random.Pick(0, 0.5, 1);
        rolling = random.Pick(0, 0.2);
        bounce = random.Pick(0.3, 0.9, 1);
        wind = DrawWind(random);
        int count = 8 + random.NextInt(3);
        for (int i = 0; i < count; i++)
        {
            // Two crossed rings of five, slightly slower or faster than circular speed.
            double radius = i < 5 ? 1.2 : 1.9;
            double turn = ((i % 5) + random.NextDouble(0, 0.2)) * (2 * Math.PI / 5);
            (double sin, double cos) = Math.SinCos(turn);
            double speed = Math.Sqrt(strength / radius) * random.NextDouble(0.8, 1.15);
            Vector3D position = new(radius * cos, i < 5 ? radius * sin : 0, i < 5 ? 0 : radius * sin);
            Vector3D velocity = new(-speed * sin, i < 5 ? speed * cos : 0, i < 5 ? 0 : speed * cos);
            Add(DrawSpec(), position, velocity);
        }
    }

    internal override long? MaxEvents => 2_000;

    internal override BodySpec DrawSpec()
    {
        ForceSet forces = random.IsLucky(75) ? ForceSet.Of(0) : random.Pick(ForceSet.Of(1), ForceSet.Of(0) | ForceSet.Of(2));
        return new BodySpec(
            random.Pick(0.15, 0.2), random.Pick(0.5, 1, 1, 3), random.Pick(bounce, 0.5, 0.9), forces: forces,
            tolerance: random.Pick(1e-3, 1e-5), friction: friction, rollingResistance: rolling);
    }

    /// <summary>Above the sphere, so that no hand releases a ball inside it.</summary>
    internal override Vector3D DrawPosition() => new(random.NextDouble(-1, 1) * 2, random.NextDouble(0.7, 2), random.NextDouble(-1, 1) * 2);

    internal override Vector3D DrawSpin(in BodySpec spec) => MayTurn(spec) ? DrawVelocity(10) : Vector3D.Zero;

    internal override Vector3D DrawVelocity(double most) =>
        new Vector3D(random.NextDouble(-1, 1), random.NextDouble(-1, 1), random.NextDouble(-1, 1)) * (most / 2);

    protected override void AddSurroundings(SceneBuilder builder)
    {
        builder.WithGravity(Vector3D.Zero).AddStaticSphere("sun", Vector3D.Zero, Sun, bounce)
            .AddForce(Force.Central("pull", Vector3D.Zero, strength))
            .AddForce(Force.Central("other pull", Vector3D.Zero, strength, power))
            .AddForce(Force.QuadraticDrag("wind", 0.05, wind));
        AddWalls(builder.AddPlane("floor", Vector3D.Up, new Vector3D(0, -Half, 0), bounce), Half, 0, bounce);
    }
}
