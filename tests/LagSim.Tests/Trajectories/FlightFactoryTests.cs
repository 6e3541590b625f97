using System;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Timelines;
using LagSim.Trajectories;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Trajectories;

/// <summary>The segment that a flight is opened on, against the textbook's formula.</summary>
public sealed class FlightFactoryTests
{
    private readonly TimelineStore timelines = new(default);

    [Theory]
    [InlineData(9.81)]
    [InlineData(1.62)]
    [InlineData(0)]
    public void Open_UnderGravityAlone_FollowsTheParabola(double gravity)
    {
        Scene scene = new SceneBuilder("air").WithGravity(V(0, -gravity)).WithSmallestRadius(0.5).Build();
        Factory(scene, Ball()).Open(0, Key(2, EventKind.Spawn), V(1, 2, 3), V(4, 5, 6), V(0, 0, 7));
        MotionSegment segment = timelines.Segment(timelines.Last(0));
        const double T = 0.7;
        Near(V(1 + (4 * T), 2 + (5 * T) - (0.5 * gravity * T * T), 3 + (6 * T)), segment.PositionAt(T, default), 1e-14);
        Near(V(4, 5 - (gravity * T), 6), segment.VelocityAt(T, default), 1e-14);
        Assert.Equal(At(2), segment.Epoch);
        Assert.Equal(V(0, 0, 7), timelines.SpinOf(timelines.Last(0)).At(T)); // nothing changes it in flight
    }

    /// <summary>Linear drag slows a body exponentially. A body that names no force flies on as it is, by the same law.</summary>
    [Theory]
    [InlineData(1, 0.25)]
    [InlineData(0, 0)]
    public void Open_WithLinearDrag_SlowsExponentiallyIfTheBodyNamesIt(int force, double rate)
    {
        Scene scene = new SceneBuilder("syrup")
            .WithGravity(Floating).WithSmallestRadius(0.5).AddForce(Force.LinearDrag("drag", 0.5)).Build();
        Factory(scene, Ball(mass: 2, flight: MotionLaw.ClosedForm, force: force)).Open(0, Key(2, EventKind.Spawn), V(1), V(8));
        MotionSegment segment = timelines.Segment(timelines.Last(0));
        double t = segment.End.SecondsSince(segment.Epoch);
        Assert.InRange(t, 1e-3, 1e6);
        Near(8 * Math.Exp(-rate * t), segment.VelocityAt(t, timelines.Dense(timelines.Last(0))).X, 1e-12);
        double way = rate > 0 ? 8 * (1 - Math.Exp(-rate * t)) / rate : 8 * t;
        Near(1 + way, segment.PositionAt(t, timelines.Dense(timelines.Last(0))).X, 1e-12 * (1 + way));
    }

    [Fact]
    public void Open_AtTheHighestSpeed_OpensAndAboveItIsLost()
    {
        Scene scene = new SceneBuilder("air").WithSmallestRadius(0.5).Build();
        FlightFactory factory = Factory(scene, Ball());
        double highest = Limits.MaxSpeed(0.5);
        factory.Open(0, Key(1, EventKind.Spawn), V(0), V(highest));
        Assert.Equal(LossReason.None, timelines.Segment(timelines.Last(0)).Loss);
        factory.Open(0, Key(2, EventKind.SetVelocity), V(0), V(Math.BitIncrement(highest)));
        Assert.Equal(LossReason.TooFast, timelines.Segment(timelines.Last(0)).Loss);
        Assert.False(timelines.Segment(timelines.Last(0)).IsPresent);
    }

    private FlightFactory Factory(Scene scene, BodySpec spec)
    {
        BodyTable bodies = new(1);
        timelines.AddSlot(bodies.Add(new BodyId(1, 1, 0), spec));
        Forces forces = new(scene, default);
        StateLimits limits = new(scene);
        return new FlightFactory(
            scene, forces, bodies, timelines, limits, new BodyLoss(bodies, timelines, limits), new ForceFailures(scene, bodies, timelines));
    }
}
