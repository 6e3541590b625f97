using System;
using LagSim.Harness.Verification.Check;
using LagSim.Scenes;
using LagSim.Testing.Links;

namespace LagSim.Harness.Verification.Worlds;

/// <summary>Draws the scenes of rooms and rows. Those with forces and with heaps are in files of their own.</summary>
internal static class WorldScenes
{
    /// <summary>The number of kinds.</summary>
    internal static readonly int Kinds = Enum.GetValues<WorldKind>().Length;

    /// <summary>The kind of a seed: each has every fourteenth.</summary>
    internal static WorldKind KindOf(ulong seed) => (WorldKind)(seed % (ulong)Kinds);

    /// <summary>Draws the scene of a seed.</summary>
    internal static WorldScene Draw(ulong seed, SeededRandom random) => KindOf(seed) switch
    {
        WorldKind.Gas => Gas(random),
        WorldKind.ElasticPit => WorldHeaps.Pit(random, isElastic: true),
        WorldKind.InelasticPit => WorldHeaps.Pit(random, isElastic: false),
        WorldKind.JammedRoom => WorldHeaps.Jammed(random),
        WorldKind.DragOnFloor => WorldForces.Drag(random),
        WorldKind.Springs => WorldForces.Springs(random),
        WorldKind.Magnetic => WorldForces.Magnetic(random),
        WorldKind.Planet => WorldForces.Planet(random),
        WorldKind.Slope => WorldHeaps.Slope(random),
        WorldKind.Chain => Chain(random),
        WorldKind.UnequalMasses => WorldHeaps.Unequal(random),
        WorldKind.Filters => Filtered(random),
        WorldKind.Sensors => Sensed(random),
        _ => DrawRuled(random, seed),
    };

    /// <summary>Adds a floor and four walls, and a ceiling where it is closed: a room from its floor up, around the origin.</summary>
    internal static SceneBuilder AddRoom(SceneBuilder builder, double half, double restitution, bool isClosed,
        Func<CollisionFilter>? filter = null)
    {
        CollisionFilter Next() => filter?.Invoke() ?? default;
        builder.AddPlane("floor", Vector3D.Up, Vector3D.Zero, restitution, filter: Next())
            .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-half, 0, 0), restitution, filter: Next())
            .AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(half, 0, 0), restitution, filter: Next())
            .AddPlane("north", new Vector3D(0, 0, 1), new Vector3D(0, 0, -half), restitution, filter: Next())
            .AddPlane("south", new Vector3D(0, 0, -1), new Vector3D(0, 0, half), restitution, filter: Next());
        return isClosed ? builder.AddPlane("ceiling", -Vector3D.Up, new Vector3D(0, 2 * half, 0), restitution, filter: Next()) : builder;
    }

    /// <summary>The n-th place of a lattice that fills a room from its floor up.</summary>
    internal static Vector3D Lattice(int n, double apart, double bottom) =>
        new(apart * ((n % 2) - 0.5), bottom + (apart * (n / 4)), apart * ((n / 2 % 2) - 0.5));

    private static WorldScene Gas(SeededRandom random)
    {
        bool isPeriodic = random.IsLucky(50);
        double restitution = random.IsLucky(70) ? 1 : 0.8;
        BodySpec DrawSpec(SeededRandom from) => new(from.NextDouble(0.1, 0.25), from.Pick(0.5, 1, 1, 1, 2), restitution);
        SceneBuilder builder = new SceneBuilder("gas").WithSmallestRadius(0.1)
            .WithGravity(isPeriodic || random.IsLucky(50) ? Vector3D.Zero : SceneBuilder.DefaultGravity);
        Vector3D middle = isPeriodic ? new Vector3D(1.5, 1.5, 1.5) : new Vector3D(0, 1, 0);
        builder = isPeriodic ? builder.WithPeriodicBox(new Vector3D(3, 3, 3)) : AddRoom(builder, 1, 1, isClosed: true);
        int count = 2 + random.NextInt(7);
        for (int n = 0; n < count; n++)
        {
            Vector3D place = middle + new Vector3D((n % 2) - 0.5, (n / 4) - 0.5, (n / 2 % 2) - 0.5);
            builder.AddBody($"b{n}", DrawSpec(random), place + WorldDraws.InCube(random, 0.1), WorldDraws.InCube(random, 4));
        }

        return new WorldScene
        {
            Kind = WorldKind.Gas,
            Scene = builder.Build(),
            DrawSpec = DrawSpec,
            DrawPlace = from => middle + WorldDraws.InCube(from, isPeriodic ? 1.49 : 0.75),
            Throw = (0.5, 8),
        };
    }

    private static WorldScene Chain(SeededRandom random)
    {
        bool isFree = random.IsLucky(40);
        double restitution = random.Pick(1, 1, 0.9, 0.5, 0), gap = random.Pick(0, 0, 1e-9, 1e-6, 1e-3);
        bool isEqual = random.IsLucky(60);
        BodySpec DrawSpec(SeededRandom from) => new(0.15, isEqual ? 1 : from.NextDouble(0.3, 3), restitution, friction: isFree ? 0 : 0.2);
        SceneBuilder builder = new SceneBuilder("chain").WithGravity(isFree ? Vector3D.Zero : SceneBuilder.DefaultGravity)
            .WithContactTolerance(random.Pick(1e-2, 1e-3, 1e-5));
        if (!isFree)
        {
            builder.AddPlane("floor", Vector3D.Up, Vector3D.Zero, 0.5);
        }

        int count = 3 + random.NextInt(5);
        for (int n = 0; n < count; n++)
        {
            Vector3D place = new((n * (0.3 + gap)) + (n * 1e-12), 0.15, 0);
            builder.AddBody($"b{n}", DrawSpec(random), n == 0 ? place - new Vector3D(0.4, 0, 0) : place, n == 0 ? new Vector3D(2, 0, 0)
                : Vector3D.Zero);
        }

        return new WorldScene
        {
            Kind = WorldKind.Chain,
            Scene = builder.Build(),
            Seconds = isFree ? 3 : 2,
            DrawSpec = DrawSpec,
            DrawPlace = from => new Vector3D(from.NextDouble(-1, 3), 0.15 + (from.IsLucky(40) ? 0 : from.NextDouble(0, 0.6)),
                from.NextDouble(-0.3, 0.3)),
            Throw = (0.05, 5),
        };
    }

    private static WorldScene Filtered(SeededRandom random)
    {
        double restitution = random.Pick(0.2, 0.6, 1);
        BodySpec DrawSpec(SeededRandom from) => new(
            from.NextDouble(0.1, 0.2), from.NextDouble(0.5, 2), restitution, friction: 0.3, filter: from.IsLucky(50) ? DrawFilter(from)
                : default);
        SceneBuilder builder = AddRoom(
            new SceneBuilder("filters").WithSmallestRadius(0.1), 0.9, 0.6, isClosed: false, () => random.IsLucky(25)
                ? DrawFilter(random) : default);
        AddBalls(builder, random, DrawSpec, 3 + random.NextInt(5), 0.5);
        return Room(WorldKind.Filters, builder.Build(), DrawSpec) with { HasFilters = true };
    }

    private static WorldScene Sensed(SeededRandom random)
    {
        double restitution = random.Pick(0.3, 0.8, 1);
        BodySpec DrawSpec(SeededRandom from) => new(from.NextDouble(0.1, 0.2), from.NextDouble(0.5, 2), restitution, friction: 0.2);
        SceneBuilder builder = AddRoom(new SceneBuilder("sensors").WithSmallestRadius(0.1), 0.9, 0.8, isClosed: true);
        int balls = 3 + random.NextInt(4);
        AddBalls(builder, random, DrawSpec, balls, 0.45);
        int sensors = 1 + random.NextInt(4);
        for (int n = 0; n < sensors; n++)
        {
            SensorCoverage coverage = random.Pick(Enum.GetValues<SensorCoverage>());
            if (random.IsLucky(40))
            {
                builder.AddSensorPlane($"s{n}", WorldDraws.Direction(random), new Vector3D(0, 0.9, 0) + WorldDraws.InCube(random, 0.4),
                    coverage);
            }
            else if (random.IsLucky(50))
            {
                builder.AddSensorSphere($"s{n}", new Vector3D(0, 0.9, 0) + WorldDraws.InCube(random, 0.6), random.NextDouble(0.2, 0.6),
                    coverage);
            }
            else
            {
                builder.AddSensorSphere($"s{n}", Vector3D.Zero, random.NextDouble(0.3, 0.6), coverage, carrier: $"b{random.NextInt(balls)}");
            }
        }

        return Room(WorldKind.Sensors, builder.Build(), DrawSpec);
    }

    /// <summary>A room of balls, with the rules of a seed.</summary>
    internal static WorldScene DrawRuled(SeededRandom random, ulong seed)
    {
        double restitution = random.Pick(0.3, 0.8, 1);
        BodySpec DrawSpec(SeededRandom from) => new(from.NextDouble(0.1, 0.2), from.NextDouble(0.5, 2), restitution, friction: 0.2);
        SceneBuilder builder = AddRoom(new SceneBuilder("rules").WithSmallestRadius(0.1), 0.9, 0.8, isClosed: true);
        AddBalls(builder, random, DrawSpec, 3 + random.NextInt(4), 0.45);
        return Room(WorldKind.Rules, builder.Build().With(new DrawnRules(seed), seed), DrawSpec);
    }

    private static WorldScene Room(WorldKind kind, Scene scene, Func<SeededRandom, BodySpec> drawSpec) => new()
    {
        Kind = kind,
        Scene = scene,
        DrawSpec = drawSpec,
        DrawPlace = from => new Vector3D(from.NextDouble(-0.65, 0.65), from.NextDouble(0.21, 1.5), from.NextDouble(-0.65, 0.65)),
    };

    private static void AddBalls(SceneBuilder builder, SeededRandom random, Func<SeededRandom, BodySpec> drawSpec, int count, double apart)
    {
        for (int n = 0; n < count; n++)
        {
            builder.AddBody($"b{n}", drawSpec(random), Lattice(n, apart, 0.25) + WorldDraws.InCube(random, 0.02),
                WorldDraws.InCube(random, 3));
        }
    }

    /// <summary>A filter, as <c>check</c> draws it.</summary>
    internal static CollisionFilter DrawFilter(SeededRandom from) => from.Pick(
        default, default, new CollisionFilter(2), new CollisionFilter(1, 1), new CollisionFilter(2, 1), new CollisionFilter(3, 2),
            CollisionFilter.None);
}
