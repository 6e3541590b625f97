using System;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Behavior;

/// <summary>Heaps of balls with friction and rolling resistance come to rest, whole.</summary>
public class HeapRestTests
{
    [Theory]
    [InlineData(4)] // a free tower of three that leans
    [InlineData(7)]
    [InlineData(10)] // balls of unequal mass
    [InlineData(12)]
    [InlineData(14)] // four towers of three
    public void Heap_WithRollingResistance_ComesToRest(int seed)
    {
        Assert.Equal(12, AtRest(seed, 0.05));
    }

    [Fact]
    public void Heap_WithoutRollingResistance_GoesOn()
    {
        Assert.InRange(AtRest(4, 0), 0, 11);
    }

    /// <summary>How many of twelve balls that fell into a bin stand still after ten seconds.</summary>
    private static int AtRest(int seed, double resistance)
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

        Simulation simulation = new(builder.Build());
        SimTime end = SimTime.FromSeconds(10);
        simulation.AdvanceTo(end);
        return Enumerable.Range(0, 12).Count(n => simulation.TryRead(BodyId.OfScene(n), end, out BodyState state)
            && state.Motion == MotionLaw.Resting && state.Spin == Vector3D.Zero);
    }

    private static Vector3D V(double x = 0, double y = 0, double z = 0) => new(x, y, z);
}
