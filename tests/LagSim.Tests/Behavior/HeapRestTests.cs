using System;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Heaps of balls with friction and rolling resistance come to rest, whole.</summary>
public sealed class HeapRestTests
{
    private const double Seconds = 10;

    [Theory]
    [InlineData(4)] // a free tower of three that leans
    [InlineData(7)]
    [InlineData(10)] // balls of unequal mass
    [InlineData(12)]
    [InlineData(14)] // four towers of three
    public void Heap_WithRollingResistance_ComesToRest(int seed)
    {
        Simulation world = Fallen(seed, 0.05);
        Assert.All(Bodies(world), body => Assert.Equal(MotionLaw.Resting, Read(world, body, Seconds).Motion));

        // Who sleeps keeps its spin. In the half second that is waited, the surface of each turned by less than the contact tolerance.
        double d = world.Scene.ContactTolerance;
        Assert.All(Bodies(world), body => Assert.InRange(Read(world, body, Seconds).Spin.Length * world.SpecOf(body).Radius, 0, d / 0.5));
        Assert.True(MinGap(world, At(Seconds)) > -2 * d);
        long events = world.EventsProcessed;
        world.AdvanceTo(At(10 * Seconds));
        Assert.Equal(events, world.EventsProcessed);
    }

    [Fact]
    public void Heap_WithoutRollingResistance_HasABallThatTurnsOn()
    {
        Simulation world = Fallen(5, 0);
        Assert.Contains(Bodies(world), body => Read(world, body, Seconds).Spin.Length > 1);
    }

    /// <summary>
    /// A ball on a dome that turns on the spot, and rolls slower than rest allows: rest ends the rolling alone. The control rolls faster,
    /// and rolls off.
    /// </summary>
    [Theory]
    [InlineData(1e-6, true)]
    [InlineData(0.5, false)]
    public void BallThatTurnsOnTheSpot_RestsWithoutRolling(double rolls, bool rests)
    {
        Scene scene = new SceneBuilder("dome").WithContactTolerance(1e-3).AddStaticSphere("dome", V(0, -5), 5, 0.2)
            .AddBody("ball", new BodySpec(0.5, 1, 0.2, friction: 0.5), V(0, 0.5), spin: V(0, 10, rolls)).Build();
        Simulation world = Run(scene, 2);
        BodyState state = Read(world, First, 2);
        Assert.Equal(rests, state.Motion == MotionLaw.Resting);
        Vector3D normal = (state.Position - V(0, -5)) / 5.5;
        Assert.Equal(rests, Vector3D.Cross(state.Spin, normal).Length < 1e-12);
        Assert.Equal(10, state.Spin.Y, 0.05);
    }

    /// <summary>Twelve balls that fell into a bin.</summary>
    private static Simulation Fallen(int seed, double resistance)
    {
        Random random = new(seed);
        SceneBuilder builder = new SceneBuilder("bin").AddPlane("floor", Vector3D.Up, 0.0).AddPlane("west", V(1), -1.1).AddPlane("east", V(-1), -1.1)
            .AddPlane("back", V(0, 0, 1), -1.1).AddPlane("front", V(0, 0, -1), -1.1);
        for (int n = 0; n < 12; n++)
        {
            double radius = 0.5 * (seed % 2 == 0 ? 1 : 0.8 + (0.2 * random.NextDouble()));
            double mass = seed % 5 == 0 ? 1 + (20 * random.NextDouble()) : 1;
            Vector3D place = V((((n % 2) - 0.5) * 1.1) + (0.02 * random.NextDouble()), 0.6 + (n / 4 * 1.1), (((n / 2 % 2) - 0.5) * 1.1) + (0.02 * random.NextDouble()));
            builder.AddBody($"ball {n}", new BodySpec(radius, mass, 0.3, friction: 0.4, rollingResistance: resistance), place, spin: V(0, random.Next(-5, 6)));
        }

        return Run(builder.Build(), Seconds);
    }
}
