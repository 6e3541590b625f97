using System;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Draws the scenes whose bodies stay in contact: pits, jammed rooms, slopes, unequal masses.</summary>
internal static class WorldHeaps
{
    internal static WorldScene Pit(SeededRandom random, bool isElastic)
    {
        double half = random.NextDouble(0.4, 0.7);
        double restitution = isElastic ? random.Pick(1, 1, 1, 0.95) : random.Pick(0, 0.2, 0.5, 0.8);
        double friction = isElastic ? 0 : random.Pick(0, 0.2, 0.5, 1), rolling = isElastic ? 0 : random.Pick(0, 0.1, 0.3);
        BodySpec DrawSpec(SeededRandom from) => new(
            from.NextDouble(0.1, 0.19), isElastic ? from.NextDouble(0.3, 2.7) : from.NextDouble(0.5, 2), restitution, friction: friction,
            rollingResistance: rolling);
        SceneBuilder builder = WorldScenes.AddRoom(
            new SceneBuilder("pit").WithSmallestRadius(0.1).WithContactTolerance(random.Pick(1e-2, 1e-3, 1e-3, 1e-4))
                .WithGravity(Vector3D.Up * -random.Pick(9.81, 9.81, 9.81, 1.62, 0.05)),
            half, 1, isClosed: false);
        int count = 4 + random.NextInt(isElastic && random.IsLucky(30) ? 15 : 8);
        for (int n = 0; n < count; n++)
        {
            Vector3D place = WorldScenes.Lattice(n, 0.39, 0.2)
                + new Vector3D(random.NextDouble(-0.004, 0.004), 0, random.NextDouble(-0.004, 0.004));
            builder.AddBody($"b{n}", DrawSpec(random), place);
        }

        return new WorldScene
        {
            Kind = isElastic ? WorldKind.ElasticPit : WorldKind.InelasticPit,
            Scene = builder.Build(),
            Seconds = isElastic && count <= 12 ? 1.5 : 2.5,
            DrawSpec = DrawSpec,
            DrawPlace = from => new Vector3D(from.NextDouble(-1, 1) * (half - 0.2), from.NextDouble(0.2, 1.5),
                from.NextDouble(-1, 1) * (half - 0.2)),
            Throw = (0.05, 4),
            HasHands = !isElastic && random.IsLucky(50),
        };
    }

    internal static WorldScene Jammed(SeededRandom random)
    {
        double restitution = random.Pick(0.0005, 0.3, 0.8), friction = random.Pick(0, 0.3, 0.93), radius = random.NextDouble(0.2, 0.25);
        BodySpec DrawSpec(SeededRandom from) =>
            new(from.IsLucky(80) ? radius : from.NextDouble(0.1, 0.25), from.Pick(1, 1, 1, 0.3, 3), 0.5, friction: friction);
        SceneBuilder builder = WorldScenes.AddRoom(
            new SceneBuilder("jam").WithSmallestRadius(0.1).WithGravity(Vector3D.Up * -random.Pick(8, 8, 8, 0.5, 0)), 0.5, restitution, isClosed: true);
        int count = 4 + random.NextInt(4);
        for (int n = 0; n < count; n++)
        {
            builder.AddBody($"b{n}", DrawSpec(random), WorldScenes.Lattice(n, 0.5, 0.25), WorldDraws.InCube(random, 2));
        }

        return new WorldScene
        {
            Kind = WorldKind.JammedRoom,
            Scene = builder.Build(),
            Seconds = 1.5,
            DrawSpec = DrawSpec,
            DrawPlace = from => from.IsLucky(50)
                ? WorldScenes.Lattice(from.NextInt(8), 0.5, 0.25)
                : new Vector3D(from.NextDouble(-0.25, 0.25), from.NextDouble(0.25, 0.75), from.NextDouble(-0.25, 0.25)),
            Throw = (0.05, 5),
            HasHands = true,
        };
    }

    internal static WorldScene Slope(SeededRandom random)
    {
        double angle = random.NextDouble(0, 1), sine = Sine(angle), cosine = Math.Sqrt(1 - (sine * sine));
        double friction = random.Pick(0, 0.2, 0.5, 1), rolling = random.Pick(0, 0, 0.05, 0.2), restitution = random.Pick(0, 0.3, 0.6);
        Vector3D normal = new(-sine, cosine, 0);
        BodySpec DrawSpec(SeededRandom from) =>
            new(0.15, from.Pick(0.5, 1, 1, 2), restitution, friction: friction, rollingResistance: rolling);
        SceneBuilder builder = new SceneBuilder("slope").WithContactTolerance(random.Pick(1e-2, 1e-3, 1e-4))
            .AddPlane("slope", normal, Vector3D.Zero, restitution)
            .AddPlane("stop", new Vector3D(1, 0, 0), new Vector3D(-1, 0, 0), restitution)
            .AddPlane("side", new Vector3D(0, 0, 1), new Vector3D(0, 0, -0.5), restitution);
        int count = 1 + random.NextInt(4);
        double apart = random.NextDouble(0.31, 0.6);
        for (int n = 0; n < count; n++)
        {
            double along = n * apart;
            Vector3D place = (new Vector3D(cosine, sine, 0) * along) + (normal * (0.15 + (random.IsLucky(50) ? 1e-9 : 0.2)));
            builder.AddBody($"b{n}", DrawSpec(random), place + new Vector3D(0, 0, random.IsLucky(50) ? -0.35 + 1e-9 : 0.1));
        }

        return new WorldScene
        {
            Kind = WorldKind.Slope,
            Scene = builder.Build(),
            Seconds = 3,
            DrawSpec = DrawSpec,
            DrawPlace = from => (new Vector3D(cosine, sine, 0) * from.NextDouble(0, 1.5)) + (normal * from.NextDouble(0.15, 0.6))
                + new Vector3D(0, 0, from.NextDouble(-0.3, 0.5)),
            Throw = (0.01, 3),
        };
    }

    internal static WorldScene Unequal(SeededRandom random)
    {
        double restitution = random.Pick(0, 0.5, 0.9), friction = random.Pick(0, 0.3);
        double spread = random.Pick(10, 100, 1000);
        BodySpec DrawSpec(SeededRandom from) =>
            new(from.NextDouble(0.1, 0.2), WorldDraws.LogUniform(from, 1 / spread, spread), restitution, friction: friction);
        SceneBuilder builder = WorldScenes.AddRoom(new SceneBuilder("unequal").WithSmallestRadius(0.1), 0.6, restitution,
            isClosed: random.IsLucky(50));
        int count = 3 + random.NextInt(4);
        for (int n = 0; n < count; n++)
        {
            builder.AddBody($"b{n}", DrawSpec(random), WorldScenes.Lattice(n, 0.42, 0.25), WorldDraws.InCube(random, 1));
        }

        return new WorldScene
        {
            Kind = WorldKind.UnequalMasses,
            Scene = builder.Build(),
            DrawSpec = DrawSpec,
            DrawPlace = from => new Vector3D(from.NextDouble(-0.39, 0.39), from.NextDouble(0.2, 0.99), from.NextDouble(-0.39, 0.39)),
            Throw = (0.05, 4),
        };
    }

    // The series to its fifth power: any angle near will do, if it is the same everywhere.
    private static double Sine(double angle) => angle * (1 - (angle * angle / 6) + (angle * angle * angle * angle / 120));
}
