using System;
using System.IO;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Scenes;

public sealed class BuiltInScenesTests
{
    [Fact]
    public void TryGet_EveryName_IsDescribedAndReadsBackTheSame()
    {
        Assert.Equal(["drop", "pair", "cradle", "billiards", "crowd", "goals"], BuiltInScenes.Names);
        foreach (string name in BuiltInScenes.Names)
        {
            Assert.True(BuiltInScenes.TryGet(name, out Scene? scene));
            Assert.Equal(name, scene.Name);
            Assert.Equal(scene.Hash, SceneSource.Load(name).Hash);
            Assert.Equal(scene.Hash, SceneText.Parse(SceneFile.ToJson(scene)).Hash);
            Assert.DoesNotContain('\n', BuiltInScenes.Describe(name));
        }
    }

    [Fact]
    public void TryGet_UnknownName_IsFalse()
    {
        Assert.False(BuiltInScenes.TryGet("Drop", out _));
        Assert.Throws<ArgumentException>(() => BuiltInScenes.Describe("Drop"));
    }

    [Fact]
    public void Drop_Default_IsTheThesis()
    {
        Scene scene = BuiltInScenes.Drop();
        SceneBody ball = scene.Bodies.Single();

        Assert.Equal(new BodySpec(0.5, 1, 0.8, MotionLaw.RungeKutta4, SimDuration.FromSeconds(1 / 200.0)), ball.Spec);
        Assert.Equal(new Vector3D(0, 10, 0), ball.Position);
        Assert.Equal(new Vector3D(0, -9.81, 0), scene.Gravity);
        Assert.Equal(1.0, scene.Planes.Single().Restitution);
    }

    [Theory]
    [InlineData(MotionLaw.Ballistic)]
    [InlineData(MotionLaw.RungeKutta4)]
    public void Drop_AfterTheLastBounce_RestsOnTheFloor(MotionLaw law)
    {
        Scene scene = BuiltInScenes.Drop(law: law);
        Simulation world = new(scene);
        world.AdvanceTo(SimTime.FromSeconds(20));

        Assert.True(world.TryRead(scene.BodyNamed("ball"), SimTime.FromSeconds(20), out BodyState state));
        Assert.Equal(MotionLaw.Resting, state.Motion);
        Assert.Equal(0.5, state.Position.Y, 1e-6);
    }

    [Theory]
    [InlineData(0.25, 0.8, 200)]
    [InlineData(double.NaN, 0.8, 200)]
    [InlineData(10, 1.5, 200)]
    [InlineData(10, 0.8, 0)]
    [InlineData(10, 0.8, double.NaN)]
    [InlineData(10, 0.8, 2e6)]
    public void Drop_ValueOutOfRange_IsRefused(double height, double restitution, double rate) =>
        Assert.Throws<SceneException>(() => BuiltInScenes.Drop(height, restitution, MotionLaw.RungeKutta4, rate));

    [Fact]
    public void Drop_BallisticAtAnyRate_IsOneWorld() =>
        Assert.Equal(BuiltInScenes.Drop(10, 0.8, MotionLaw.Ballistic, 50).Hash, BuiltInScenes.Drop(10, 0.8, MotionLaw.Ballistic, 200).Hash);

    [Theory]
    [InlineData(MotionLaw.Ballistic)]
    [InlineData(MotionLaw.RungeKutta4)]
    public void Pair_Default_MeetsInFlightOffCentreThenBounces(MotionLaw law)
    {
        Scene scene = BuiltInScenes.Pair(law);
        Simulation world = new(scene, new SimulationOptions(history: SimDuration.MaxValue));
        world.AdvanceTo(SimTime.FromSeconds(3));

        TimelineEntry[] light = Impacts(world, scene.BodyNamed("light"));
        TimelineEntry[] heavy = Impacts(world, scene.BodyNamed("heavy"));
        Assert.Equal(light[0].Key.Time, heavy[0].Key.Time);
        Assert.Equal(0.8626, light[0].Key.Time.ToSeconds(), 1e-3);
        Vector3D across = heavy[0].State.Position - light[0].State.Position;
        Assert.Equal(0.9, across.Length, 1e-6);
        Assert.True(across.Y > 0.2 && across.Z > 0.1 && light[0].State.Position.Y > 1);
        Assert.True(light.Length > 1 && light[1].State.Velocity.Y > 0, "the light ball bounces after that");
        Assert.True(heavy.Length > 1 && heavy[1].State.Velocity.Y > 0, "and so does the heavy one");
    }

    [Fact]
    public void WithMotion_ToAndFro_IsTheSameWorld() =>
        Assert.Equal(
            BuiltInScenes.Pair().Hash,
            BuiltInScenes.WithMotion(BuiltInScenes.Pair(MotionLaw.RungeKutta4), MotionLaw.Ballistic, BodySpec.DefaultStep).Hash);

    [Fact]
    public void WithMotion_SlopeOfOddBits_KeepsEveryOtherBit()
    {
        Scene was = new SceneBuilder("slope")
            .WithGravity(new Vector3D(0.1, -1, 0)).WithRestitutionThreshold(1e-7).WithContactTolerance(2e-5)
            .WithSmallestRadius(0.01).WithSpawners(PeerSet.Of(1))
            .AddPlane("slope", new Vector3D(0.77492974874327403, 0.7115880677996147, 0.16164369655849575), new Vector3D(0.1, -3, 0.7), 0.3)
            .AddStaticSphere("rock", new Vector3D(9, 0, 0), 1, 0.4)
            .AddBody("ball", new BodySpec(0.5, 1, 0.8), new Vector3D(0, 10, 0), players: PeerSet.Of(0, 3))
            .Build();

        Scene now = BuiltInScenes.WithMotion(was, MotionLaw.RungeKutta4, SimDuration.FromSeconds(0.01));

        Assert.Equal(new BodySpec(0.5, 1, 0.8, MotionLaw.RungeKutta4, SimDuration.FromSeconds(0.01)), now.Bodies[0].Spec);
        Assert.Equal(was.Hash, BuiltInScenes.WithMotion(now, MotionLaw.Ballistic, BodySpec.DefaultStep).Hash);
    }

    [Fact]
    public void Load_NeitherNameNorFile_ListsTheNames()
    {
        SceneFileException refusal = Assert.Throws<SceneFileException>(() => SceneSource.Load("dorp"));

        Assert.Equal("dorp: this is neither a built-in scene (drop, pair, cradle, billiards, crowd, goals, crowd-N for N from 1 to 100000) nor a file that exists", refusal.Message);
        Assert.Throws<SceneFileException>(() => SceneSource.Load(""));
        Assert.Contains("this is a folder", Assert.Throws<SceneFileException>(() => SceneSource.Load(Path.GetTempPath())).Message);
    }

    private static TimelineEntry[] Impacts(Simulation world, BodyId body) =>
        [.. world.Timeline(body).Where(entry => entry.Key.Kind == EventKind.Impact)];

    [Fact]
    public void Describe_ABody_NamesThoseOfTheSceneAlone()
    {
        Scene scene = BuiltInScenes.Pair();
        Assert.Equal($"body '{scene.Bodies[1].Name}' (0.0.1)", scene.Describe(BodyId.OfScene(1)));
        Assert.Equal("body 0.0.99", scene.Describe(BodyId.OfScene(99)));
        Assert.Equal("body 1.2.0", scene.Describe(new BodyId(1, 2, 0)));
    }
}
