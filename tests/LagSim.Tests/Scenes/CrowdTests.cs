using System;
using System.Linq;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Scenes;

public sealed class CrowdTests
{
    [Theory]
    [InlineData("crowd", 200)]
    [InlineData("crowd-1", 1)]
    [InlineData("crowd-27", 27)]
    [InlineData("crowd-28", 28)]
    [InlineData("crowd-100000", 100_000)]
    public void TryGet_NameWithANumber_HasThatManyBallsEachInACellOfItsOwn(string name, int bodies)
    {
        Assert.True(BuiltInScenes.TryGet(name, out Scene? scene));
        Assert.Equal((name, bodies), (scene.Name, scene.Bodies.Count));
        Assert.Equal(bodies, scene.Bodies.Select(body => Cell(body.Position)).Distinct().Count());
        Assert.True(scene.Bodies.All(body => Cell(body.Position - Margin(body)) == Cell(body.Position + Margin(body))));
        Assert.Contains($"{bodies}", BuiltInScenes.Describe(name), StringComparison.Ordinal);

        // The box is the smallest cube with enough cells.
        double edge = -scene.Planes.Single(plane => plane.Name == "ceiling").Offset;
        Assert.True(Math.Pow(edge, 3) > bodies - 0.5 && Math.Pow(edge - 1, 3) < bodies - 0.5);
    }

    [Theory]
    [InlineData("crowd-0")]
    [InlineData("crowd-100001")]
    [InlineData("crowd-")]
    [InlineData("crowd--5")]
    [InlineData("crowd-+5")]
    [InlineData("crowd-05")]
    [InlineData("crowd-5.0")]
    [InlineData("crowd- 5")]
    [InlineData("crowd-99999999999")]
    [InlineData("Crowd")]
    public void TryGet_NoSuchNumber_IsFalseAndTheErrorSaysWhatThereIs(string name)
    {
        Assert.False(BuiltInScenes.TryGet(name, out Scene? scene));
        Assert.Null(scene);
        Assert.Contains("crowd-N for N from 1 to 100000", Assert.Throws<SceneFileException>(() => SceneSource.Load(name)).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(() => BuiltInScenes.Describe(name));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(100_001)]
    public void Crowd_NumberOutOfRange_IsRefused(int bodies)
    {
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(() => BuiltInScenes.Crowd(bodies));
        Assert.Contains("1 to 100000", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Crowd_OfOneNumber_IsAlwaysTheSame()
    {
        // Pinned: on every machine. Every random draw of the layout is in it.
        Assert.Equal("029d579d75c8e169", $"{BuiltInScenes.Crowd().Hash:x16}");
        Assert.Equal(BuiltInScenes.Crowd().Hash, SceneSource.Load("crowd").Hash);
        Assert.NotEqual(BuiltInScenes.Crowd(199).Hash, BuiltInScenes.Crowd().Hash);
    }

    [Fact]
    public void Crowd_ForAWhile_StaysInTheBoxApartKeepsItsEnergyAndMoves()
    {
        const double length = 10;
        Simulation world = new(BuiltInScenes.Crowd(100));
        double energy = Energy(world, At(0));
        long half = 0;
        for (double time = 0; time <= length; time += 0.1)
        {
            world.AdvanceTo(At(time));
            Assert.True(MinGap(world, At(time)) > -1e-9, $"at {time} s");
            half = time <= length / 2 ? world.ImpactsProcessed : half;
        }

        Near(1, Energy(world, At(length)) / energy, 1e-13);
        Assert.InRange((double)(world.ImpactsProcessed - half) / half, 0.8, 1.25);
        Assert.InRange(world.ImpactsProcessed, 100 * length, 4 * 100 * length);
    }

    [Fact]
    public void MinGap_OfABoxWithoutItsCeiling_IsSeenToBeLeft()
    {
        Scene whole = BuiltInScenes.Crowd(8);
        SceneBuilder open = new SceneBuilder("open").WithGravity(whole.Gravity);
        foreach (StaticPlane plane in whole.Planes.Where(plane => plane.Name != "ceiling"))
        {
            open.AddPlane(plane.Name, plane.Normal, plane.Offset);
        }

        foreach (SceneBody body in whole.Bodies)
        {
            open.AddBody(body.Name, body.Spec, body.Position, body.Velocity);
        }

        Simulation world = Run(open.Build(), 10);
        Assert.Contains(Bodies(world), body => whole.Planes.Any(plane => plane.Gap(Read(world, body, 10).Position, world.SpecOf(body).Radius) < -1));
    }

    private static Vector3D Margin(SceneBody body) => V(1, 1, 1) * (body.Spec.Radius * (1 - 1e-9));

    private static (double, double, double) Cell(Vector3D position) => (Math.Floor(position.X), Math.Floor(position.Y), Math.Floor(position.Z));
}
