using System;
using System.Linq;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Determinism;

/// <summary>The event path allocates nothing once as many segments were alive as will be.</summary>
public sealed class AllocationTests
{
    private const int Events = 10_000;

    [Theory]
    [InlineData(MotionLaw.Ballistic)]
    [InlineData(MotionLaw.RungeKutta4)]
    public void AdvanceTo_TenThousandEventsAfterWarmUp_AllocatesNothing(MotionLaw flight)
    {
        // The least of a few: a collection that another test causes gives this thread's allocation buffer back, which counts as allocated.
        (long bytes, long events) = Enumerable.Range(0, 5).Select(_ => Measure(Pair(flight, 0))).Min();
        Assert.InRange(events, Events, long.MaxValue);
        Assert.Equal(0, bytes);
    }

    [Fact]
    public void Measure_ForceThatAllocates_IsSeen()
    {
        Scene scene = Pair(MotionLaw.RungeKutta4, 1);
        Assert.True(Measure(scene).Bytes > Events * 32);
    }

    private static (long Bytes, long Events) Measure(Scene scene)
    {
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.25)));
        Advance(simulation, Events); // warm-up
        long eventsBefore = simulation.EventsProcessed;
        long before = GC.GetAllocatedBytesForCurrentThread();
        Advance(simulation, Events);
        return (GC.GetAllocatedBytesForCurrentThread() - before, simulation.EventsProcessed - eventsBefore);
    }

    private static void Advance(Simulation simulation, long events)
    {
        for (long target = simulation.EventsProcessed + events; simulation.EventsProcessed < target;)
        {
            simulation.AdvanceTo(simulation.SimulatedTo + SimDuration.FromSeconds(1.0 / 64));
        }
    }

    /// <summary>Two balls between walls, elastic: each hits the other, the floor and a wall again and again.</summary>
    private static Scene Pair(MotionLaw flight, byte force) => new SceneBuilder("pair")
        .AddForce(Force.Supplied(new FunctionForce((_, x, _) => V(new double[8].Length * 0.0, x.Y * 0))))
        .AddPlane("floor", Vector3D.Up, V(0)).AddPlane("west", V(1), V(-1)).AddPlane("east", V(-1), V(1))
        .AddBody("a", Ball(0.25, flight: flight, force: force), V(-0.5, 1), V(10)).AddBody("b", Ball(0.25, 2, flight: flight, force: force), V(0.5, 0.9), V(-7)).Build();
}
