using System;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Draws the scenes whose bodies are under forces.</summary>
internal static class WorldForces
{
    internal static WorldScene Drag(SeededRandom random)
    {
        bool isQuadratic = random.IsLucky(60);
        Vector3D wind = random.IsLucky(30) ? WorldDraws.InCube(random, 3) : Vector3D.Zero;
        double strength = isQuadratic ? WorldDraws.LogUniform(random, 1e-3, 3e-2) : WorldDraws.LogUniform(random, 1e-3, 1);
        double restitution = random.Pick(0, 0.3, 0.5, 0.8), friction = random.Pick(0, 0, 0.3);
        SceneBuilder builder = new SceneBuilder("drag").WithSmallestRadius(0.1)
            .AddForce(isQuadratic ? Force.QuadraticDrag("air", strength, wind) : Force.LinearDrag("oil", strength, wind), out ForceSet drag)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero);
        bool isWalled = random.IsLucky(30);
        if (isWalled)
        {
            builder.AddPlane("wall", new Vector3D(-1, 0, 0), new Vector3D(2, 0, 0));
        }

        double lightest = WorldDraws.LogUniform(random, 1e-3, 0.03);
        BodySpec DrawSpec(SeededRandom from) =>
            new(from.NextDouble(0.1, 0.2), lightest * WorldDraws.LogUniform(from, 1, 10), restitution, forces: drag, friction: friction);
        int count = 1 + random.NextInt(3);
        for (int n = 0; n < count; n++)
        {
            BodySpec spec = DrawSpec(random);
            builder.AddBody($"b{n}", spec, new Vector3D((0.5 * n) - 0.5, spec.Radius + (random.IsLucky(60) ? 0 : 0.3), 0));
        }

        return new WorldScene
        {
            Kind = WorldKind.DragOnFloor,
            Scene = builder.Build(),
            Seconds = 1.5,
            DrawSpec = DrawSpec,
            DrawPlace = from => new Vector3D(from.NextDouble(-1, 1.7), from.NextDouble(0.2, 1), from.NextDouble(-0.5, 0.5)),
            Throw = (1, 990),
            FieldSpeed = wind.Length,
        };
    }

    internal static WorldScene Springs(SeededRandom random)
    {
        double stiffness = WorldDraws.LogUniform(random, 1, 3000), damping = random.Pick(0, 0, 0.1, 5);
        double restitution = random.Pick(0, 0.5, 0.9), friction = random.Pick(0, 0.3);
        bool hasGravity = random.IsLucky(70);
        SceneBuilder builder = new SceneBuilder("springs").WithSmallestRadius(0.1)
            .WithGravity(hasGravity ? SceneBuilder.DefaultGravity : Vector3D.Zero)
            .AddForce(Force.Spring("spring", new Vector3D(0, random.Pick(-0.5, 0.15, 0.8), 0), stiffness, damping), out ForceSet spring)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero);
        BodySpec DrawSpec(SeededRandom from) => new(
            from.NextDouble(0.1, 0.2), from.NextDouble(0.3, 3), restitution, forces: from.IsLucky(80) ? spring : ForceSet.None,
                friction: friction);
        int count = 1 + random.NextInt(4);
        for (int n = 0; n < count; n++)
        {
            builder.AddBody($"b{n}", DrawSpec(random), WorldScenes.Lattice(n, 0.45, 0.25), WorldDraws.InCube(random, 2));
        }

        return new WorldScene
        {
            Kind = WorldKind.Springs,
            Scene = builder.Build(),
            Seconds = 1.5,
            DrawSpec = DrawSpec,
            DrawPlace = from => new Vector3D(from.NextDouble(-0.6, 0.6), from.NextDouble(0.2, 1), from.NextDouble(-0.6, 0.6)),
            FieldSpeed = 2 * Math.Sqrt(stiffness / 0.3),
        };
    }

    internal static WorldScene Magnetic(SeededRandom random)
    {
        double restitution = random.Pick(0, 0.4, 0.8), friction = random.Pick(0, 0.3, 0.6);
        SceneBuilder builder = new SceneBuilder("magnetic").WithSmallestRadius(0.1)
            .AddForce(Force.Magnetic("coil", WorldDraws.InCube(random, 1), WorldDraws.LogUniform(random, 0.1, 20)), out ForceSet coil)
            .AddForce(Force.Magnus("swerve", WorldDraws.LogUniform(random, 1e-3, 0.3)), out ForceSet swerve)
            .AddPlane("floor", Vector3D.Up, Vector3D.Zero);
        if (random.IsLucky(40))
        {
            builder.AddPlane("wall", new Vector3D(-1, 0, 0), new Vector3D(2, 0, 0));
        }

        BodySpec DrawSpec(SeededRandom from) => new(
            from.NextDouble(0.1, 0.2), from.NextDouble(0.3, 2), restitution, forces: from.Pick(coil, coil, swerve, coil | swerve),
                friction: friction);
        int count = 1 + random.NextInt(4);
        for (int n = 0; n < count; n++)
        {
            builder.AddBody(
                $"b{n}", DrawSpec(random), WorldScenes.Lattice(n, 0.45, 0.25), WorldDraws.InCube(random, 3),
                    spin: WorldDraws.InCube(random, 20));
        }

        return new WorldScene
        {
            Kind = WorldKind.Magnetic,
            Scene = builder.Build(),
            DrawSpec = DrawSpec,
            DrawPlace = from => new Vector3D(from.NextDouble(-1, 1.7), from.NextDouble(0.2, 1), from.NextDouble(-0.5, 0.5)),
        };
    }

    internal static WorldScene Planet(SeededRandom random)
    {
        double pull = random.NextDouble(2, 20), restitution = random.Pick(0, 0.4, 0.8, 1), friction = random.Pick(0, 0.4);
        int power = random.Pick(-2, -2, -2, -1, 1);
        bool hasFilters = random.IsLucky(25);
        SceneBuilder builder = new SceneBuilder("planet").WithSmallestRadius(0.1).WithGravity(Vector3D.Zero)
            .AddForce(Force.Central("pull", Vector3D.Zero, pull, power), out ForceSet central)
            .AddStaticSphere("planet", Vector3D.Zero, 1, 1);
        BodySpec DrawSpec(SeededRandom from) =>
            new(from.NextDouble(0.1, 0.2), from.NextDouble(0.5, 2), restitution, forces: central, friction: friction);
        int count = 1 + random.NextInt(4);
        for (int n = 0; n < count; n++)
        {
            BodySpec spec = DrawSpec(random);
            double height = random.IsLucky(30) ? 1 + spec.Radius + 1e-9 : random.NextDouble(1.3, 2);
            Vector3D place = n switch { 0 => new(1, 0, 0), 1 => new(0, 1, 0), 2 => new(-1, 0, 0), _ => new(0, -1, 0) };
            builder.AddBody($"b{n}", spec, place * height, height > 1.25 ? WorldDraws.InCube(random, 3) : Vector3D.Zero);
        }

        return new WorldScene
        {
            Kind = WorldKind.Planet,
            Scene = builder.Build(),
            DrawSpec = DrawSpec,
            DrawPlace = from => WorldDraws.Direction(from) * from.NextDouble(1.2 + 1e-6, 2),
            FieldSpeed = hasFilters ? 1e12 : Math.Sqrt(2 * pull) * 10, // there is no bound for what falls through the sphere to its centre
            Throw = (0.05, 8),
            HasFilters = hasFilters,
        };
    }
}
