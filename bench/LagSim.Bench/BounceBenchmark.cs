using BenchmarkDotNet.Attributes;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What one impact costs, all of it: taken off the queue, gathered, solved, the paths opened and the next contacts found.</summary>
[MemoryDiagnoser]
public class BounceBenchmark
{
    private static readonly SimTime Late = SimTime.FromSeconds(1_000_000); // a hundred million bounces would otherwise come to the end of time

    private readonly Scene floorScene = BuiltInScenes.Drop(0.51, 1, MotionLaw.Ballistic);
    private readonly Scene tableScene = BuiltInScenes.Billiards(1, 1);
    private readonly Scene pairScene =
        new SceneBuilder("pair").WithGravity(Vector3D.Zero)
            .AddPlane("west", new Vector3D(1, 0, 0), new Vector3D(-2, 0, 0)).AddPlane("east", new Vector3D(-1, 0, 0), new Vector3D(2, 0, 0))
            .AddBody("a", new BodySpec(0.3, 1, 1), new Vector3D(-1, 0, 0), new Vector3D(3, 0, 0))
            .AddBody("b", new BodySpec(0.3, 2, 1), new Vector3D(1, 0, 0), new Vector3D(-1, 0, 0)).Build();

    private Simulation simulation = null!;

    [GlobalSetup(Target = nameof(OnFloor))]
    public void WarmFloor() => Warm(floorScene);

    [GlobalSetup(Target = nameof(OfTwo))]
    public void WarmPair() => Warm(pairScene);

    [GlobalSetup(Target = nameof(AmongSixteen))]
    public void WarmTable() => Warm(tableScene);

    /// <summary>A ball on a floor.</summary>
    [Benchmark(Baseline = true)]
    public long OnFloor() => OneImpact(floorScene);

    /// <summary>Two balls between two walls.</summary>
    [Benchmark]
    public long OfTwo() => OneImpact(pairScene);

    /// <summary>Sixteen balls between four cushions, elastic so that it never ends: each impact is followed by a look at all the others.</summary>
    [Benchmark]
    public long AmongSixteen() => OneImpact(tableScene);

    private long OneImpact(Scene scene)
    {
        if (simulation.Horizon > Late)
        {
            Warm(scene);
        }

        long before = simulation.ImpactsProcessed;
        while (simulation.ImpactsProcessed == before)
        {
            simulation.AdvanceTo(simulation.Horizon + SimDuration.OneTick);
        }

        return simulation.ImpactsProcessed - before;
    }

    private void Warm(Scene scene)
    {
        simulation = new Simulation(scene);
        simulation.AdvanceTo(SimTime.FromSeconds(20));
    }
}
