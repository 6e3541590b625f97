using BenchmarkDotNet.Attributes;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What the event loop costs: an elastic ball for a simulated time, in closed form and integrated, and a late event among others.</summary>
[MemoryDiagnoser]
public class SimulationBenchmark
{
    private static readonly SimDuration Second = SimDuration.FromSeconds(1);

    private Simulation ballistic = null!;
    private Simulation integrated = null!;
    private Simulation late = null!;
    private uint sequence;

    [GlobalSetup]
    public void Warm()
    {
        // Low bounces: about 11 contacts a second.
        ballistic = new Simulation(BuiltInScenes.Drop(0.51, 1, MotionLaw.Ballistic));
        integrated = new Simulation(BuiltInScenes.Drop(0.51, 1, MotionLaw.RungeKutta4));
        late = new Simulation(BuiltInScenes.Pair());
        ballistic.AdvanceTo(SimTime.FromSeconds(10));
        integrated.AdvanceTo(SimTime.FromSeconds(10));
        late.AdvanceTo(SimTime.FromSeconds(2));
    }

    /// <summary>One simulated second of an elastic ball in closed form: 11 contacts.</summary>
    [Benchmark(Baseline = true)]
    public void BallisticSecond() => ballistic.AdvanceTo(ballistic.SimulatedTo + Second);

    /// <summary>The same by RK4 at 200 Hz: 200 steps and 11 contacts.</summary>
    [Benchmark]
    public void RungeKuttaSecond() => integrated.AdvanceTo(integrated.SimulatedTo + Second);

    /// <summary>An event 100 ms late in a scene of two bodies: cut, and simulate 100 ms again.</summary>
    [Benchmark]
    public SubmitResult LateEvent()
    {
        late.AdvanceTo(late.SimulatedTo + SimDuration.FromMilliseconds(10));
        SimTime now = late.SimulatedTo;
        SubmitResult result = late.Submit(ExternalEvent.Impulse(now - SimDuration.FromMilliseconds(100), 1, ++sequence, BodyId.OfScene(0), new Vector3D(0, 1, 0)));
        late.AdvanceTo(now);
        return result;
    }
}
