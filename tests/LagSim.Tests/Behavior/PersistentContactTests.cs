using System;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Persistent contacts that no plane covers: bodies move and rest as one island, in a bounded number of events, and nothing sinks into anything.</summary>
public sealed class PersistentContactTests
{
    /// <summary>A contact tolerance, in metres, at which a place within a few of it is exact for these balls of half a metre.</summary>
    private const double Fine = 1e-7;

    [Theory]
    [InlineData(0)]
    [InlineData(0.5)]
    [InlineData(0.9)]
    public void StaticSphere_BallExactlyOnTop_RestsAndCostsNothing(double e)
    {
        // It falls by 0.1 m, bounces until the last, and then takes half a second of steps until it sleeps, and two for those begun.
        Scene scene = Dome(0, e);
        double d = scene.ContactTolerance;
        double most = Tolerance.BouncesUntilLast(0.1, e, scene.RestitutionThreshold) + (0.5 * Tolerance.StepsASecond(d)) + 2;
        Simulation simulation = Run(scene, 10);
        Assert.InRange(simulation.EventsProcessed, 1, most);
        BodyState state = Read(simulation, First, 10);
        Assert.Equal(MotionLaw.Resting, state.Motion);
        Assert.Equal(0, state.Position.X);
        Near(1.5, state.Position.Y, 1e-12);
    }

    [Fact]
    public void StaticSphere_BallOffCentre_RollsOffAndRestsOnTheFloor()
    {
        Simulation simulation = Run(Dome(0.01, 0.3), 20);
        BodyState state = Read(simulation, First, 20);
        Near(0.5 - 2, state.Position.Y, 1e-8);
        Assert.True(state.Position.X > 1);
        Assert.Equal(MotionLaw.Sliding, state.Motion);
        Assert.InRange(simulation.EventsProcessed, 100, 10_000);
    }

    [Theory]
    [InlineData(0.3, 1)]
    [InlineData(0.8, 1)]
    [InlineData(0.3, 10)]
    [InlineData(0.5, 0.1)]
    public void Stack_OfTwo_Rests(double e, double massAbove)
    {
        Simulation simulation = Run(Stack(e, 1, massAbove), 10);
        long before = simulation.EventsProcessed;
        simulation.AdvanceTo(At(11));
        Assert.Equal(0, simulation.EventsProcessed - before);
        Near(0.5, Read(simulation, First, 11).Position.Y, 2 * Fine); // a contact may be off by 2 d
        Near(1.5, Read(simulation, Second, 11).Position.Y, 4 * Fine);
        Assert.True(MinGap(simulation, At(11)) > -2 * Fine);
    }

    [Theory]
    [InlineData(0.05, 1)]
    [InlineData(0.5, 1)]
    [InlineData(0.5, 10)]
    public void Stack_OfThree_Rests(double e, double massOnTop)
    {
        Scene scene = new SceneBuilder("three").WithContactTolerance(Fine).AddPlane("floor", Vector3D.Up, V(0), e)
            .AddBody("below", Ball(e: e), V(0, 0.5)).AddBody("middle", Ball(e: e), V(0, 1.5))
            .AddBody("top", Ball(mass: massOnTop, e: e), V(0, 2.6)).Build();
        Simulation simulation = Run(scene, 2);
        long before = simulation.EventsProcessed;
        simulation.AdvanceTo(At(2.5));
        Assert.Equal(0, simulation.EventsProcessed - before);
        Near(2.5, Read(simulation, Third, 2.5).Position.Y, 6 * Fine);
        Assert.True(MinGap(simulation, At(2.5)) > -2 * Fine);
    }

    [Theory]
    [MemberData(nameof(Loads))]
    public void HeavyOnLight_AtAnyMassRatio_IsCarried(double ratio, double e)
    {
        // One event a step for both together. They may take half a second to stand still within d, and another one later they sleep.
        Simulation simulation = Run(Carried(ratio, e), 1.1);
        Assert.InRange(simulation.EventsProcessed, 1, Tolerance.StepsASecond(Fine));
        BodyState heavy = Read(simulation, Second, 1.1);
        Assert.Equal(MotionLaw.Resting, heavy.Motion);
        Near(1.5, heavy.Position.Y, 4 * Fine);
        foreach (double t in new[] { 0.01, 0.1, 0.3, 1.1 })
        {
            Assert.True(MinGap(simulation, At(t)) > -2 * Fine, $"{MinGap(simulation, At(t))} m at {t} s");
        }
    }

    /// <summary>
    /// Two to seven balls in a shaft, each on the one below and against two of its walls, stand where they are put: whatever they weigh,
    /// with and without friction and rolling resistance.
    /// </summary>
    [Fact]
    public void Column_OfAnyMassesInAShaft_Stands()
    {
        const double Aside = 0.25, Wall = -Aside - 0.5, Tolerance = 1e-4;
        double rise = Math.Sqrt(1 - (8 * Aside * Aside));
        for (ulong seed = 1; seed <= 40; seed++)
        {
            SeededRandom random = new(seed);
            int count = 2 + random.NextInt(6);
            double friction = random.IsLucky(33) ? 0 : random.NextDouble();
            double resistance = random.IsLucky(33) ? 0.05 * random.NextDouble() : 0;
            SceneBuilder builder = new SceneBuilder("shaft").WithContactTolerance(Tolerance)
                .AddPlane("floor", Vector3D.Up, 0.0, 0, friction)
                .AddPlane("west", V(1), Wall, 0, friction).AddPlane("east", V(-1), Wall, 0, friction)
                .AddPlane("north", V(0, 0, 1), Wall, 0, friction).AddPlane("south", V(0, 0, -1), Wall, 0, friction);
            for (int n = 0; n < count; n++)
            {
                double mass = Math.Pow(10, random.NextDouble(-6, 6));
                builder.AddBody($"ball {n}", new BodySpec(0.5, mass, 0, friction: friction, rollingResistance: resistance), Place(n));
            }

            Simulation simulation = new(builder.Build(), new SimulationOptions());
            simulation.AdvanceTo(At(2));
            for (int n = 0; n < count; n++)
            {
                double moved = (Read(simulation, BodyId.OfScene(n), 2).Position - Place(n)).Length;
                Assert.True(moved < 0.01 * Tolerance, $"seed {seed}, ball {n} of {count}: {moved} m");
            }
        }

        Vector3D Place(int n) => V(n % 2 == 0 ? -Aside : Aside, 0.5 + (n * rise), n % 2 == 0 ? -Aside : Aside);
    }

    [Fact]
    public void HeavyOnLight_WithoutIslands_IsSeenToStorm()
    {
        Scene scene = new SceneBuilder("carried").AddStaticSphere("dome", V(0, -5), 5, 0.5).AddBody("light", Ball(e: 0.5), V(0, 0.5 + 1e-5))
            .AddBody("heavy", Ball(mass: 1e6, e: 0.5), V(0, 1.5 + 1e-4)).Build();
        foreach (bool ignores in new[] { false, true })
        {
            long budget = 5_000;
            Simulation simulation = new(scene, KeepAll.WithParts(new FaultyEngineParts { IgnoresIslands = ignores }));
            Assert.Equal(!ignores, simulation.TryAdvanceTo(At(1), ref budget)); // without, a million a second
        }
    }

    [Fact]
    public void HeavyDroppedOnLight_OfSixtyDecades_EndsCarried()
    {
        Simulation simulation = Run(Dropped(0.5), 1.5);
        Assert.InRange(simulation.EventsProcessed, 1, 2 * 1.5 * Tolerance.StepsASecond(Fine)); // of at most two islands, always in steps
        BodyState heavy = Read(simulation, Third, 1.5);
        Assert.Equal(MotionLaw.Resting, heavy.Motion);
        Near(2.5, heavy.Position.Y, 6 * Fine);
        Assert.True(MinGap(simulation, At(1.5)) > -2 * Fine);
    }

    [Fact]
    public void HeavyDroppedOnLight_OfSixtyDecadesAndNoLoss_BouncesAsHighAsItFell()
    {
        Simulation simulation = Run(Dropped(1), 1.5);
        Assert.True(simulation.ImpactsClosed > 0);
        Assert.InRange(Energy(simulation, At(1.5)), Energy(simulation, At(0)) * (1 - 1e-9), Energy(simulation, At(0)) * (1 + 1e-9));
        Assert.True(MinGap(simulation, At(1.5)) > -2 * Fine);
    }

    private static Scene Dropped(double e) => new SceneBuilder("dropped").WithContactTolerance(Fine).AddPlane("floor", Vector3D.Up, V(0), e)
        .AddBody("below", Ball(e: e), V(0, 0.5)).AddBody("light", Ball(mass: 1e-30, e: e), V(0, 1.5))
        .AddBody("heavy", Ball(mass: 1e30, e: e), V(0, 2.5 + 1e-4)).Build();

    [Theory]
    [InlineData(1, 0.5, 2e-9, 0)]
    [InlineData(1, 0.8, 1e-8, 0.003)]
    [InlineData(2, 0.2, 0, 0.003)]
    [InlineData(1000, 0.8, 1e-12, 0.1)]
    [InlineData(0.001, 0.5, 1e-7, 0.1)]
    public void Row_ThatJustFitsBetweenWalls_EndsWithoutGainOfEnergy(double mass, double e, double slack, double off)
    {
        // The third ball falls between the other two, where almost nothing can give way.
        Scene scene = new SceneBuilder("row").AddPlane("floor", Vector3D.Up, V(0), e)
            .AddPlane("west", V(1), V(-1.5 - slack), e).AddPlane("east", V(-1), V(1.5 + slack), e)
            .AddBody("left", Ball(e: e), V(-1, 0.5)).AddBody("right", Ball(e: e), V(1, 0.5)).AddBody("falls", Ball(mass: mass, e: e), V(off, 1.55)).Build();
        Simulation simulation = new(scene, KeepAll);
        double energy = Energy(simulation, At(0));
        for (double t = 0.05; t <= 2; t += 0.05)
        {
            simulation.AdvanceTo(At(t));
            Assert.InRange(Energy(simulation, At(t)), 0, energy * (1 + 1e-9));
        }

        simulation.AdvanceTo(At(2));
        Assert.InRange(simulation.EventsProcessed, 10, 20_000);
        Assert.True(MinGap(simulation, At(2)) > -2e-9);
    }

    [Theory]
    [InlineData(0.02)]
    [InlineData(0.05)]
    public void ThreeBalls_RestitutionBelowTheThreshold_CollapseAndEnd(double e)
    {
        Assert.True(e < 7 - (4 * Math.Sqrt(3)));
        Simulation simulation = Run(Three(e), 5);
        Assert.InRange(simulation.EventsProcessed, 10, 1000);
        Assert.All(Bodies(simulation), body => Near(0, Read(simulation, body, 5).Velocity.X, 1e-6)); // and do not part, as above the threshold
        Near(0, Momentum(simulation, At(5)).X, 1e-14);
        Assert.True(MinGap(simulation, At(5)) > -1e-9);
    }

    [Theory]
    [InlineData(0.09)]
    [InlineData(0.5)]
    public void ThreeBalls_RestitutionAboveTheThreshold_PartAfterAFewHits(double e)
    {
        Assert.True(e > 7 - (4 * Math.Sqrt(3)));
        Simulation simulation = Run(Three(e), 5);
        Assert.InRange(simulation.EventsProcessed, 2, 40);
        Assert.DoesNotContain(Impacts(simulation, Second), impact => impact.Key.Round > 0);
        Assert.True(MinGap(simulation, At(5)) > 0);
    }

    [Theory]
    [InlineData(0.5, 9.81)]
    [InlineData(0, 0)]
    [InlineData(1, 9.81)]
    [InlineData(1, 0)]
    public void BetweenTwoPlanes_WithNoRoom_TheBallKeepsOnlyItsMotionAlong(double e, double g)
    {
        Simulation simulation = Run(NoRoom(e, g), 5);
        BodyState state = Read(simulation, First, 5);
        Near(V(10, 0.5), state.Position, 2e-9);
        Near(V(2), state.Velocity, 1e-6);
        Assert.InRange(simulation.EventsProcessed, 1, 10_000);
    }

    private static Scene NoRoom(double e, double g) => new SceneBuilder("press").WithGravity(V(0, -g)).AddPlane("floor", Vector3D.Up, V(0), e)
        .AddPlane("ceiling", V(0, -1), V(0, 1), e).AddBody("ball", Ball(), V(0, 0.5), V(2, 1)).Build();

    [Theory]
    [InlineData(0.1, 0.5)]
    [InlineData(0.001, 0.5)]
    [InlineData(0.001, 0.9)]
    public void Wedge_BallDrivenIntoIt_JamsInFiniteEvents(double slope, double e)
    {
        double jam = ((0.5 * Math.Sqrt(1 + (slope * slope))) - 1) / slope;
        Scene scene = new SceneBuilder("wedge").AddPlane("left", V(1, slope), V(-1), e).AddPlane("right", V(-1, slope), V(1), e)
            .AddBody("ball", Ball(), V(0.0001, jam + (0.001 / slope)), V(0, -1)).Build();
        Simulation simulation = Run(scene, 5);
        Near(jam, Read(simulation, First, 5).Position.Y, 1e-6);
        Assert.Equal(MotionLaw.Resting, Read(simulation, First, 5).Motion);
        Assert.InRange(simulation.EventsProcessed, 3, 2000);
    }

    public static TheoryData<double, double> Loads
    {
        get
        {
            TheoryData<double, double> loads = [];
            foreach (double ratio in new[] { 1e-6, 1, 10, 100, 101, 1e3, 1e6, 1e12, 1e60 })
            {
                foreach (double e in new[] { 0, 0.05, 0.5, 0.9, 1 })
                {
                    loads.Add(ratio, e);
                }
            }

            return loads;
        }
    }

    private static Scene Carried(double ratio, double e) => new SceneBuilder("carried").WithContactTolerance(Fine)
        .AddStaticSphere("dome", V(0, -5), 5, e).AddBody("light", Ball(mass: ratio == 1e60 ? 1e-30 : 1, e: e), V(0, 0.5))
        .AddBody("heavy", Ball(mass: Math.Min(ratio, 1e30), e: e), V(0, 1.5)).Build();

    private static Scene Dome(double x, double e) => new SceneBuilder("dome").AddPlane("floor", Vector3D.Up, V(0, -2), 0).AddStaticSphere("dome", V(0), 1, e)
        .AddBody("ball", Ball(), V(x, 1.6)).Build();

    private static Scene Stack(double e, double below, double above) => new SceneBuilder("stack").WithContactTolerance(Fine)
        .AddPlane("floor", Vector3D.Up, V(0), e).AddBody("below", Ball(mass: below, e: e), V(0, 0.5))
        .AddBody("above", Ball(mass: above, e: e), V(0, 1.75)).Build();

    private static Scene Three(double e) => new SceneBuilder("three").WithGravity(Floating)
        .AddBody("left", Ball(e: e), V(-2), V(1)).AddBody("middle", Ball(e: e), V(0)).AddBody("right", Ball(e: e), V(2.5), V(-1)).Build();
}
