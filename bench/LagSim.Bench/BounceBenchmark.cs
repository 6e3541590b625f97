using BenchmarkDotNet.Attributes;
using LagSim.Harness.Scenes;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What one impact costs, all of it: taken off the queue, gathered, solved, the paths opened and the next contacts found.</summary>
[MemoryDiagnoser]
public class BounceBenchmark
{
    private Simulation floor = null!;
    private Simulation pair = null!;
    private Simulation table = null!;

    [GlobalSetup]
    public void Warm()
    {
        floor = new Simulation(BuiltInScenes.Drop(0.51, 1, MotionLaw.Ballistic));
        pair = new Simulation(new SceneBuilder("pair").WithGravity(Vector3D.Zero)
            .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-2, 0, 0)).AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(2, 0, 0))
            .AddBody("a", new BodySpec(0.3, 1, 1), new Vector3D(-1, 0, 0), new Vector3D(3, 0, 0))
            .AddBody("b", new BodySpec(0.3, 2, 1), new Vector3D(1, 0, 0), new Vector3D(-1, 0, 0)).Build());
        table = new Simulation(BuiltInScenes.Billiards(1, 1));
        foreach (Simulation simulation in new[] { floor, pair, table })
        {
            simulation.AdvanceTo(SimTime.FromSeconds(20));
        }
    }

    /// <summary>A ball on a floor.</summary>
    [Benchmark(Baseline = true)]
    public long OnFloor() => OneImpact(floor);

    /// <summary>Two balls between two walls.</summary>
    [Benchmark]
    public long OfTwo() => OneImpact(pair);

    /// <summary>Sixteen balls between four cushions, elastic so that it never ends: each impact is followed by a look at all the others.</summary>
    [Benchmark]
    public long AmongSixteen() => OneImpact(table);

    private static long OneImpact(Simulation simulation)
    {
        long before = simulation.ImpactsProcessed;
        while (simulation.ImpactsProcessed == before)
        {
            simulation.AdvanceTo(simulation.Horizon + SimDuration.OneTick);
        }

        return simulation.ImpactsProcessed - before;
    }
}
