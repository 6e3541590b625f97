using System;
using System.Linq;
using LagSim.Harness.SceneFiles;
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
    [InlineData(MotionLaw.ClosedForm)]
    [InlineData(MotionLaw.DormandPrince54)]
    public void AdvanceTo_TenThousandEventsAfterWarmUp_AllocatesNothing(MotionLaw flight)
    {
        // The least of a few: a collection that another test causes gives this thread's allocation buffer back, which counts as allocated.
        (long bytes, long events) = Enumerable.Range(0, 5).Select(_ => Measure(flight < MotionLaw.Held ? Pair(flight, 0) : Forced(flight))).Min();
        Assert.InRange(events, Events, long.MaxValue);
        Assert.Equal(0, bytes);
    }

    [Theory]
    [InlineData(300, 0.2)] // among so many an index names who is near, and the queue has slices
    [InlineData(1_000, 0.45)]
    public void AdvanceTo_ManyBodiesAfterWarmUp_AllocatesNothing(int bodies, double fraction)
    {
        // Room for what is listed grows with the longest lists there have been, so that the longer it runs the rarer it becomes: the last of a few has none.
        Simulation simulation = new(BuiltInScenes.Gas(bodies, fraction), new SimulationOptions(default, SimDuration.FromSeconds(1.0 / 64)));
        long least = Enumerable.Range(0, 12).Select(_ => Measure(simulation).Bytes).Skip(4).Min();
        Assert.Equal(0, least);
    }

    /// <summary>With friction, whose impacts turn bodies, and with islands: balls that slide over a floor under a spring, and a row of them in a groove.</summary>
    [Theory]
    [InlineData("rough")]
    [InlineData("springs")]
    [InlineData("rough springs")]
    [InlineData("row")]
    public void AdvanceTo_FrictionAndIslandsAfterWarmUp_AllocatesNothing(string name)
    {
        Scene scene = name switch { "rough" => Rough(), "row" => Row(), _ => OnSprings(name == "springs" ? 0 : 0.3) };
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.25)));
        long least = Enumerable.Range(0, 8).Select(_ => Measure(simulation, 1_000).Bytes).Skip(4).Min();
        Assert.Equal(0, least);
        Assert.Equal(name != "rough", Enumerable.Range(0, scene.Bodies.Count).Any(n => Read(simulation, BodyId.OfScene(n), simulation.SimulatedTo.ToSeconds()).Motion == MotionLaw.Constrained));
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
        return Measure(simulation);
    }

    private static (long Bytes, long Events) Measure(Simulation simulation, long events = Events)
    {
        long eventsBefore = simulation.EventsProcessed;
        long before = GC.GetAllocatedBytesForCurrentThread();
        Advance(simulation, events);
        return (GC.GetAllocatedBytesForCurrentThread() - before, simulation.EventsProcessed - eventsBefore);
    }

    private static void Advance(Simulation simulation, long events)
    {
        for (long target = simulation.EventsProcessed + events; simulation.EventsProcessed < target;)
        {
            simulation.AdvanceTo(simulation.SimulatedTo + SimDuration.FromSeconds(1.0 / 64));
        }
    }

    /// <summary>The same two under linear forces, on a law that is not a parabola's.</summary>
    private static Scene Forced(MotionLaw flight) => new SceneBuilder("forced")
        .AddForce(Force.LinearDrag("oil", 1e-3), out ForceSet oil).AddForce(Force.Spring("spring", V(0, 1), 3), out ForceSet spring).AddForce(Force.Magnetic("coil", V(1, 1, 1), 2), out ForceSet coil)
        .AddPlane("floor", Vector3D.Up, V(0)).AddPlane("west", V(1), V(-1)).AddPlane("east", V(-1), V(1))
        .AddBody("a", new BodySpec(0.25, 1, 1, flight, forces: oil | spring | coil), V(-0.5, 1), V(10))
        .AddBody("b", new BodySpec(0.25, 2, 1, flight, forces: spring), V(0.5, 0.9), V(-7)).Build();

    /// <summary>Elastic balls with friction between walls.</summary>
    private static Scene Rough()
    {
        SceneBuilder builder = new SceneBuilder("rough").AddPlane("floor", Vector3D.Up, V(0)).AddPlane("ceiling", V(0, -1), V(0, 4))
            .AddPlane("west", V(1), V(-2)).AddPlane("east", V(-1), V(2)).AddPlane("north", V(0, 0, 1), V(0, 0, -2)).AddPlane("south", V(0, 0, -1), V(0, 0, 2));
        for (int i = 0; i < 12; i++)
        {
            builder.AddBody($"ball {i}", new BodySpec(0.2, 1 + i, 1, friction: 0.3), V((i % 4) - 1.5, 0.5 + (i / 4)), V(3 + i, 2, 1 - i), spin: V(i, 3, -i));
        }

        return builder.Build();
    }

    /// <summary>Balls that slide, or roll, to and fro on a floor, each in an island of its own.</summary>
    private static Scene OnSprings(double friction)
    {
        SceneBuilder builder = new SceneBuilder("springs").WithContactTolerance(1e-6).AddForce(Force.Spring("spring", V(0, 1), 30), out ForceSet spring).AddPlane("floor", Vector3D.Up, V(0));
        for (int i = 0; i < 4; i++)
        {
            builder.AddBody($"ball {i}", new BodySpec(0.2, 1, 0, forces: spring, friction: friction), V(0.5 + i, 0.2), V(0, 0, 1));
        }

        return builder.Build();
    }

    /// <summary>A row of balls that lean on each other and slide along a groove for ever, one island.</summary>
    private static Scene Row()
    {
        double half = Math.Sqrt(0.5);
        SceneBuilder builder = new SceneBuilder("row").AddForce(Force.Spring("spring", V(0), 30), out ForceSet spring)
            .AddPlane("left", V(half, half), 0.0, 0).AddPlane("right", V(-half, half), 0.0, 0);
        for (int i = 0; i < 3; i++)
        {
            builder.AddBody($"ball {i}", new BodySpec(0.5, 1, 0, forces: spring), V(0, half, i), V(0, 0, 1));
        }

        return builder.Build();
    }

    /// <summary>Two balls between walls, elastic: each hits the other, the floor and a wall again and again.</summary>
    private static Scene Pair(MotionLaw flight, byte force) => new SceneBuilder("pair")
        .AddForce(Force.Supplied(new FunctionForce((_, x, _) => V(new double[8].Length * 0.0, x.Y * 0))))
        .AddPlane("floor", Vector3D.Up, V(0)).AddPlane("west", V(1), V(-1)).AddPlane("east", V(-1), V(1))
        .AddBody("a", Ball(0.25, flight: flight, force: force), V(-0.5, 1), V(10)).AddBody("b", Ball(0.25, 2, flight: flight, force: force), V(0.5, 0.9), V(-7)).Build();
}
