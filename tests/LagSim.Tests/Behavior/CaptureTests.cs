using System;
using LagSim.Scenes;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>
/// The third case of rule 7 (docs/CONTACT.md): a ball that strikes a static sphere stays where its rebound would rise by at most the
/// tolerance and all bounces to come would be over within a step. A rebound a little faster is a bounce.
/// </summary>
public sealed class CaptureTests
{
    [Theory]
    [InlineData(0.1, 1e-3)] // the height decides
    [InlineData(0.6, 1e-3)]
    [InlineData(0.9, 1e-3)] // how long the bounces go on decides
    [InlineData(0.99, 1e-4)]
    [InlineData(0.5, 1e-6)]
    public void Rebound_UpToTheBound_IsTheLast(double restitution, double tolerance)
    {
        double step = Math.Sqrt(2 * tolerance / Gravity);
        double bound = Math.Min(Math.Sqrt(2 * Gravity * tolerance), Gravity * StepOf(tolerance) * (1 - restitution) / 2);
        Assert.InRange(StepOf(tolerance), step / 2, step);
        Assert.Equal(MotionLaw.Constrained, LawAfterRebound(0.999 * bound, restitution, tolerance));
        Assert.Equal(MotionLaw.Ballistic, LawAfterRebound(1.001 * bound, restitution, tolerance));
    }

    /// <summary>
    /// The step of rule 1: the largest power of two of ticks within the time of a fall by the tolerance, where that is below 1/64 s.
    /// </summary>
    private static double StepOf(double tolerance)
    {
        double tick = Time.SimDuration.OneTick.ToSeconds();
        return tick * Math.Pow(2, Math.Floor(Math.Log2(Math.Min(Math.Sqrt(2 * tolerance / Gravity), 1.0 / 64) / tick)));
    }

    private static MotionLaw LawAfterRebound(double rebound, double restitution, double tolerance)
    {
        Scene scene = new SceneBuilder("dome").WithContactTolerance(tolerance).AddStaticSphere("dome", V(0, -1), 1)
            .AddBody("ball", new BodySpec(0.5, 1, restitution), V(0, 0.5), V(0, -rebound / restitution)).Build();
        Simulation world = new(scene);
        Assert.Equal(1, world.ImpactsProcessed); // at once
        return Read(world, First, 0).Motion;
    }
}
