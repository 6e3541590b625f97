using System;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>What is done in a quick way for two in free flight is, to the bit, what is done in the general way; with an index of shells and without.</summary>
public sealed class ShortcutTests
{
    [Theory]
    [InlineData(1, 40, 0, false)]
    [InlineData(2, 100, 0, false)]
    [InlineData(3, 100, -9.81, false)]
    [InlineData(4, 120, 0, true)]
    [InlineData(5, 30, -9.81, false)]
    public void Crowd_WithAndWithoutShortcuts_IsTheSameToTheBit(int seed, int bodies, double gravity, bool boxed)
    {
        Scene scene = Crowd(seed, bodies, gravity, boxed);
        Simulation quick = Play(scene, EngineParts.Usual);
        Simulation general = Play(scene, new FaultyEngineParts { TakesNoShortcut = true });
        Assert.Equal(general.EventHash(At(2)), quick.EventHash(At(2)));
        Assert.Equal(general.StateHash(At(2)), quick.StateHash(At(2)));
        Assert.Equal(general.ImpactsProcessed, quick.ImpactsProcessed);
        Assert.Equal(0, general.Engine.Isolated.PairCount);
        Assert.True(quick.Engine.Isolated.PairCount > bodies / 2, $"{quick.Engine.Isolated.PairCount} of {quick.ImpactsProcessed}");
    }

    [Fact]
    public void Symmetric_WhereMoreThanTwoMeetAtOnce_IsTheSameToTheBit()
    {
        Scene scene = Symmetric();
        Simulation quick = Play(scene, EngineParts.Usual);
        Simulation general = Play(scene, new FaultyEngineParts { TakesNoShortcut = true });
        Assert.True(quick.ImpactsProcessed > 3, $"{quick.ImpactsProcessed}");
        Assert.Equal(general.EventHash(At(2)), quick.EventHash(At(2)));
    }

    [Theory]
    [InlineData(1.0, 0.0)]
    [InlineData(0.9, 0.0)]
    [InlineData(0.5, 0.4)] // comes to rest, or rolls on
    public void Bounces_OnPlanesAndASphere_AreTheSameToTheBit(double restitution, double friction)
    {
        Scene scene = Court(restitution, friction);
        Simulation quick = Play(scene, EngineParts.Usual, 12);
        Simulation general = Play(scene, new FaultyEngineParts { TakesNoShortcut = true }, 12);
        Assert.Equal(general.EventHash(At(12)), quick.EventHash(At(12)));
        Assert.Equal(general.StateHash(At(12)), quick.StateHash(At(12)));
        Assert.Equal(0, general.Engine.Isolated.Count);
        Assert.True(quick.Engine.Isolated.Count > quick.Engine.Isolated.PairCount + 20, $"{quick.Engine.Isolated.Count} of {quick.ImpactsProcessed}");
    }

    [Fact]
    public void Corner_WithTiesTakenForOneSurface_IsSeenToDiffer()
    {
        Scene scene = new SceneBuilder("corner").WithGravity(V(0)).AddPlane("west", V(1), 0).AddPlane("floor", V(0, 1), 0)
            .AddBody("ball", new BodySpec(0.5, 1, 1), V(2, 2), V(-1, -1)).Build();
        ulong general = Play(scene, new FaultyEngineParts { TakesNoShortcut = true }).EventHash(At(2));
        Assert.Equal(general, Play(scene, EngineParts.Usual).EventHash(At(2)));
        Assert.NotEqual(general, Play(scene, new FaultyEngineParts { IgnoresTies = true }).EventHash(At(2)));
    }

    [Fact]
    public void Symmetric_WithTiesTakenForPairs_IsSeenToDiffer()
    {
        Scene scene = Symmetric();
        ulong general = Play(scene, new FaultyEngineParts { TakesNoShortcut = true }).EventHash(At(2));
        Assert.NotEqual(general, Play(scene, new FaultyEngineParts { IgnoresTies = true }).EventHash(At(2)));
    }

    [Theory]
    [InlineData(6, 90, 0)]
    [InlineData(7, 110, -9.81)]
    public void Crowd_UnderEveryIndex_IsTheSameToTheBit(int seed, int bodies, double gravity)
    {
        Scene scene = Crowd(seed, bodies, gravity, false);
        Simulation shells = new(scene, new SimulationOptions().WithBruteForceLimit(0));
        Simulation pairs = new(scene, new SimulationOptions().WithBruteForceLimit(int.MaxValue));
        shells.AdvanceTo(At(2));
        pairs.AdvanceTo(At(2));
        Assert.Equal(pairs.EventHash(At(2)), shells.EventHash(At(2)));
        Assert.True(shells.ImpactsProcessed > bodies, $"{shells.ImpactsProcessed}");
    }

    /// <summary>While a world heals, bodies are tested against all pieces of the others' paths, of which most surely stay apart.</summary>
    [Fact]
    public void Heals_WithAndWithoutShortcuts_AreTheSameToTheBit()
    {
        int missed = 0;
        for (int seed = 0; seed < 300; seed++)
        {
            RandomWorld world = new(seed, hands: seed % 2 == 1, forced: seed % 4 == 2);
            Simulation general = world.Shuffled(seed, parts: new FaultyEngineParts { TakesNoShortcut = true });
            string? difference = RandomWorld.Difference(general, world.Shuffled(seed));
            Assert.True(difference is null, $"seed {seed}: {difference}");
            missed += RandomWorld.Difference(general, world.Shuffled(seed, parts: new FaultyEngineParts { OverlooksPastPaths = true })) is null ? 0 : 1;
        }

        Assert.True(missed > 20, $"Who takes them for apart without looking is right in all but {missed} worlds."); // the control
    }

    // Before the first impact and after the first predictions, which both kinds of world have made alike.
    private static Simulation Play(Scene scene, EngineParts parts, double seconds = 2)
    {
        Simulation simulation = new(scene, new SimulationOptions().WithParts(parts));
        simulation.AdvanceTo(At(seconds));
        return simulation;
    }

    private static Scene Crowd(int seed, int bodies, double gravity, bool boxed)
    {
        Random random = new(seed);
        int along = (int)Math.Ceiling(Math.Cbrt(bodies));
        SceneBuilder builder = new SceneBuilder("crowd").WithGravity(V(0, gravity));
        if (boxed)
        {
            builder.WithPeriodicBox(V(along, along, along));
        }
        else
        {
            foreach ((string axis, Vector3D normal) in new[] { ("x", V(1)), ("y", V(0, 1)), ("z", V(0, 0, 1)) })
            {
                builder.AddPlane($"{axis} from", normal, 0.0).AddPlane($"{axis} to", -normal, -along);
            }
        }

        for (int n = 0; n < bodies; n++)
        {
            Vector3D place = V((n % along) + 0.5, (n / along % along) + 0.5, (n / along / along) + 0.5);
            double radius = boxed ? 0.4 : 0.25 + (0.2 * random.NextDouble());
            builder.AddBody($"ball {n}", new BodySpec(radius, 0.5 + random.NextDouble(), 1), place, V(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5) * 6);
        }

        return builder.Build();
    }

    /// <summary>A few balls of all sizes that bounce on a floor, between walls, and off a ball that stands there.</summary>
    private static Scene Court(double restitution, double friction)
    {
        SceneBuilder builder = new SceneBuilder("court").AddPlane("floor", V(0, 1), 0, 1, friction).AddPlane("west", V(1), -3, 1, friction).AddPlane("east", V(-1), -3, 1, friction)
            .AddPlane("slope", V(0.6, 0.8), -1.6, 1, friction).AddStaticSphere("bollard", V(0, 0.2), 0.4, 1, friction);
        for (int n = 0; n < 5; n++)
        {
            builder.AddBody($"ball {n}", new BodySpec(0.1 + (0.02 * n), 1 + n, restitution, friction: friction), V(-2 + n, 1 + (0.3 * n)), V(1 - (0.7 * n), 0, 0.3 * n));
        }

        return builder.Build();
    }

    /// <summary>
    /// A ball is struck, and then strikes two at the very same tick, of which the later in order waits for nothing: only the one that was struck has seen it.
    /// </summary>
    private static Scene Symmetric() => new SceneBuilder("symmetric").WithGravity(V(0))
        .AddPlane("left", V(1), -6.5).AddPlane("right", V(-1), -6.5).AddPlane("near", V(0, 0, 1), -3.5).AddPlane("far", V(0, 0, -1), -3.5)
        .AddBody("struck", new BodySpec(0.5, 1, 1), V(0))
        .AddBody("striker", new BodySpec(0.5, 1, 1), V(-2), V(2))
        .AddBody("one", new BodySpec(0.5, 2, 1), V(2, 0, 0.625))
        .AddBody("other", new BodySpec(0.5, 2, 1), V(2, 0, -0.625))
        .AddBody("behind one", new BodySpec(0.5, 3, 1), V(4, 0, 2.625), V(-1, 0, -1))
        .AddBody("behind other", new BodySpec(0.5, 3, 1), V(4, 0, -2.625), V(-1, 0, 1))
        .Build();
}
