using BenchmarkDotNet.Attributes;
using LagSim.Collisions;
using LagSim.Harness.SceneFiles;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Bench;

/// <summary>What a path costs: to read it at a time, and to find when two paths touch.</summary>
[MemoryDiagnoser]
public class MotionBenchmark
{
    private static readonly SimTime End = SimTime.FromSeconds(1);
    private static readonly StaticPlane Floor = BuiltInScenes.Drop().Planes[0];

    private MotionSegment ballistic;
    private MotionSegment other;
    private MotionSegment resting;
    private MotionSegment step;
    private DenseOutput dense;
    private double seconds;

    [GlobalSetup]
    public void Make()
    {
        Vector3D fall = new(0, -9.81, 0);
        ballistic = new MotionSegment(MotionLaw.Ballistic, SimTime.Zero, SimTime.MaxValue, new Vector3D(-3, 4, 0), new Vector3D(3, 2, 0), fall);
        other = new MotionSegment(MotionLaw.Ballistic, SimTime.Zero, SimTime.MaxValue, new Vector3D(3, 4.3, 0.2), new Vector3D(-3, 2, 0), fall);
        resting = MotionSegment.AtRest(SimTime.Zero, new Vector3D(-1.5, 3.5, 0));
        step = new MotionSegment(MotionLaw.RungeKutta4, SimTime.Zero, End, new Vector3D(-3, 4, 0), new Vector3D(3, 2, 0), fall);
        dense = new DenseOutput(new Vector3D(0.01, 0, 0.002), new Vector3D(0, 0.001, 0), new Vector3D(1e-4, 0, 0));
    }

    /// <summary>Where a body in closed-form flight is.</summary>
    [Benchmark(Baseline = true)]
    public Vector3D PositionBallistic() => ballistic.PositionAt(seconds += 1e-9, default);

    /// <summary>Where a body is within a Runge-Kutta step: a polynomial of degree five.</summary>
    [Benchmark]
    public Vector3D PositionRungeKutta() => step.PositionAt(seconds += 1e-9, dense);

    /// <summary>When a parabola meets a plane: a quadratic.</summary>
    [Benchmark]
    public bool ContactWithPlane() => TimeOfImpact.WithPlane(ballistic, default, 0.5, Floor, SimTime.Zero, End, out _);

    /// <summary>When two parabolas of one acceleration meet: their relative motion is a straight line.</summary>
    [Benchmark]
    public bool ContactOfTwoInFlight() => TimeOfImpact.WithSphere(ballistic, default, other, default, 0.9, SimTime.Zero, End, out _);

    /// <summary>When a parabola meets a body at rest: a quartic.</summary>
    [Benchmark]
    public bool ContactWithOneAtRest() => TimeOfImpact.WithSphere(ballistic, default, resting, default, 0.9, SimTime.Zero, End, out _);

    /// <summary>When a Runge-Kutta step meets a body in flight: a polynomial of degree ten.</summary>
    [Benchmark]
    public bool ContactOfARungeKuttaStep() => TimeOfImpact.WithSphere(step, dense, other, default, 0.9, SimTime.Zero, End, out _);
}
