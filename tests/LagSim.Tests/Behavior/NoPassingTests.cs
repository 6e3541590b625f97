using System;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>No body enters another, a plane or a static sphere, whatever they do; and reading leaves no trace.</summary>
public sealed class NoPassingTests
{
    private const double Slack = 1e-9;

    /// <summary>What the sweeps of a contact step leave is a two hundredth of the contact tolerance.</summary>
    private const double PartOfTolerance = 0.01;

    private const double End = 1.5;

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Gap_RandomScenesDenselySampled_IsNeverNegative(int block)
    {
        for (int seed = block * 25; seed < (block + 1) * 25; seed++)
        {
            Simulation simulation = Run(RandomBox(seed, contacts: true), End);
            double least = Sampled(simulation);
            double slack = simulation.Engine.Stepper.StepsTaken == 0 ? Slack : PartOfTolerance * simulation.Scene.ContactTolerance;
            Assert.True(least >= -slack, $"seed {seed}: {least:R} m");
            Assert.True(simulation.EventsProcessed > 1, $"seed {seed}");
        }
    }

    [Fact]
    public void Sampled_BodiesThatSeeNeitherEachOther_IsSeenToBeNegative()
    {
        // The same scenes, each body alone in its world: put together, they pass through each other.
        int passed = 0;
        for (int seed = 0; seed < 10; seed++)
        {
            Scene scene = RandomBox(seed, contacts: true);
            Simulation[] alone = scene.Bodies.Select(body =>
            {
                SceneBuilder builder = Box(scene.Gravity, scene.Planes[0].Restitution);
                return Run(builder.AddBody(body.Name, body.Spec, body.Position, body.Velocity).Build(), End);
            }).ToArray();
            double least = Enumerable.Range(0, 300).Select(i => At(End * i / 300)).Min(time => (
                from i in Enumerable.Range(0, alone.Length)
                from j in Enumerable.Range(0, i)
                select (Read(alone[i], First, time).Position - Read(alone[j], First, time).Position).Length
                    - scene.Bodies[i].Spec.Radius - scene.Bodies[j].Spec.Radius).Min());
            passed += least < -Slack ? 1 : 0;
        }

        Assert.True(passed > 5, $"{passed}");
    }

    [Fact]
    public void Reading_AnythingAnyHowOften_ChangesNothing()
    {
        Scene scene = RandomBox(3, contacts: true);
        Simulation read = new(scene, KeepAll), unread = new(scene, KeepAll);
        Random random = new(1);
        for (int i = 1; i <= 60; i++)
        {
            SimTime now = At(End * i / 60);
            read.AdvanceTo(now);
            for (int k = 0; k < 20; k++)
            {
                SimTime time = SimTime.FromTicks((long)(random.NextDouble() * now.Ticks));
                read.StateHash(time);
                read.EventHash(time);
                read.TryRead(read.BodyAt(random.Next(read.BodyCount)), time, out _);
            }

            Assert.Throws<ArgumentOutOfRangeException>(() => read.StateHash(read.Horizon + SimDuration.OneTick));
            read.Timeline(First);
        }

        unread.AdvanceTo(At(End));
        Assert.Equal(unread.EventsProcessed, read.EventsProcessed);
        SameTimelines(unread, read);
        Assert.Equal(unread.StateHash(At(End)), read.StateHash(At(End)));
    }

    private static double Sampled(Simulation simulation)
    {
        double least = double.MaxValue;
        for (int i = 0; i <= 600; i++)
        {
            least = Math.Min(least, MinGap(simulation, At(End * i / 600)));
        }

        // And where it is closest: at and next to the impacts themselves.
        foreach (SimTime time in Bodies(simulation).SelectMany(body => Impacts(simulation, body)).Select(impact => impact.Key.Time).Distinct().Take(1500))
        {
            least = Math.Min(least, MinGap(simulation, time));
            least = Math.Min(least, MinGap(simulation, time > At(0) ? time - SimDuration.OneTick : time));
        }

        return least;
    }

    private static SceneBuilder Box(Vector3D gravity, double e) => new SceneBuilder("box").WithGravity(gravity)
        .AddPlane("floor", Vector3D.Up, V(0), e).AddPlane("west", V(1, 0.25), V(-2), e).AddPlane("east", V(-1), V(2), e)
        .AddPlane("south", V(0, 0, 1), V(0, 0, -1), e).AddPlane("north", V(0, 0, -1), V(0, 0, 1), e).AddPlane("roof", V(0, -1), V(0, 4), e)
        .AddForce(Force.Supplied(new FunctionForce((_, _, v) => v * (-0.2 * v.Length)))).AddStaticSphere("stone", V(0, 0.2), 0.5, 0.8);

    private static Scene RandomBox(int seed, bool contacts)
    {
        Random random = new(seed);
        SceneBuilder builder = Box(seed % 4 == 0 ? Floating : V(0, -Gravity), random.Next(2, 5) / 4.0);
        int bodies = contacts ? random.Next(2, 9) : 1;
        for (int i = 0; i < bodies; i++)
        {
            bool integrated = random.Next(3) == 0;
            BodySpec spec = Ball(
                0.1 + (random.NextDouble() * 0.2), Math.Pow(10, random.Next(-1, 2)), random.Next(2, 5) / 4.0,
                integrated ? MotionLaw.RungeKutta4 : MotionLaw.Ballistic, integrated ? 0.02 : 0, (byte)(integrated ? random.Next(2) : 0));
            Vector3D position = V(-0.9 + (0.6 * (i % 4)), 1.5 + (0.8 * (i / 4)), (random.NextDouble() - 0.5) * 0.8);
            builder.AddBody($"ball {i}", spec, position, V(Speed(random), Speed(random), Speed(random)));
        }

        return builder.Build();
    }

    private static double Speed(Random random) => (random.NextDouble() - 0.5) * (random.Next(4) == 0 ? 60 : 8);
}
