using System.Linq;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Rest and sliding on planes: what carries a body, and what ends it.</summary>
public sealed class SupportTests
{
    private static readonly Vector3D LeftSlope = V(0.6, 0.8);
    private static readonly Vector3D RightSlope = V(-0.6, 0.8);

    [Fact]
    public void Rest_OnAPlane_CostsNothingAndDoesNotDrift()
    {
        Simulation simulation = Run(Drop(1, 0.5), 10);
        long events = simulation.EventsProcessed;
        BodyState before = Read(simulation, First, 10);
        simulation.AdvanceTo(At(100_000));
        Assert.Equal(events, simulation.EventsProcessed);
        Assert.Equal(SimTime.MaxValue, simulation.Horizon);
        SameBits(before, Read(simulation, First, 100_000));
        Assert.Equal(MotionLaw.Resting, before.Motion);
        Assert.Equal(V(0, 0.5), before.Position);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(0.5)]
    [InlineData(0.9)]
    public void Bouncing_UntilRest_NeverGainsEnergy(double e)
    {
        Simulation simulation = Run(Drop(1, e), 20);
        double last = double.MaxValue;
        foreach (SimTime time in Enumerable.Range(0, 2001).Select(i => At(i / 100.0)))
        {
            double energy = Energy(simulation, time);
            Assert.True(energy <= last * (1 + 1e-14), $"{energy:R} after {last:R} at {time}");
            last = energy;
        }
    }

    [Fact]
    public void Rest_BallThatStartsTouching_RestsFromTheStart()
    {
        Simulation simulation = Run(Drop(0, 0.5), 1);
        Assert.Equal(MotionLaw.Resting, Read(simulation, First, 0).Motion);
        Assert.Equal(1, simulation.EventsProcessed);
    }

    [Theory]
    [InlineData(MotionLaw.Ballistic)]
    [InlineData(MotionLaw.RungeKutta4)]
    public void Slide_DownAnIncline_IsTheClosedForm(MotionLaw flight)
    {
        Simulation simulation = Run(Slope(flight), 100);
        Vector3D along = Vector3D.Up * -Gravity;
        along -= LeftSlope * Vector3D.Dot(LeftSlope, along);
        foreach (double t in new[] { 0, 0.5, 1, 10, 100 })
        {
            BodyState state = Read(simulation, First, t);
            Assert.Equal(MotionLaw.Sliding, state.Motion);
            Near((LeftSlope * 0.5) + V(0, 0, 2 * t) + (along * (0.5 * t * t)), state.Position, 1e-14 * (1 + (20 * t * t)));
            Near(V(0, 0, 2) + (along * t), state.Velocity, 1e-14 * (1 + (20 * t)));
            Near(0, simulation.Scene.Planes[0].Gap(state.Position, 0.5), 1e-14 * (1 + (20 * t * t)));
        }

        Assert.Equal(1, simulation.EventsProcessed);
    }

    [Fact]
    public void Slide_ClosedFormWithTheWrongGravity_IsSeenToMiss()
    {
        Vector3D end = Read(Run(Slope(MotionLaw.Ballistic), 10), First, 10).Position;
        Vector3D along = Vector3D.Up * -9.82;
        along -= LeftSlope * Vector3D.Dot(LeftSlope, along);
        Assert.True((end - ((LeftSlope * 0.5) + V(0, 0, 20) + (along * 50))).Length > 1e-3);
    }

    [Fact]
    public void Drop_OntoAnIncline_EndsSlidingWithItsTangentialMotion()
    {
        // Frictionless: the speed along the slope is that of gravity along it, bounces or not.
        Scene scene = new SceneBuilder("slope").AddPlane("slope", LeftSlope, V(0), 0.5).AddBody("ball", Ball(), V(0, 2)).Build();
        Simulation simulation = Run(scene, 8);
        BodyState state = Read(simulation, First, 8);
        Assert.Equal(MotionLaw.Sliding, state.Motion);
        Near(0.6 * Gravity * 8, Vector3D.Dot(state.Velocity, V(0.8, -0.6)), 1e-8);
        Near(0, Vector3D.Dot(state.Velocity, LeftSlope), 1e-12);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(3)]
    public void Groove_BallInIt_RestsOrSlidesAlongIt(double along)
    {
        double height = 0.5 / 0.8;
        Simulation simulation = Run(Groove(V(0, height), V(0, 0, along)), 50);
        BodyState state = Read(simulation, First, 50);
        Assert.Equal(along == 0 ? MotionLaw.Resting : MotionLaw.Sliding, state.Motion);
        Near(V(0, height, along * 50), state.Position, 1e-13);
        Assert.Equal(V(0, 0, along), state.Velocity);
        Assert.InRange(simulation.EventsProcessed, 1, 10);
    }

    [Theory]
    [InlineData(0.3, 0.5)]
    [InlineData(-0.2, 0.8)]
    [InlineData(0.001, 0)]
    public void Groove_BallDroppedIntoIt_SettlesInIt(double x, double e)
    {
        Simulation simulation = Run(Groove(V(x, 2), V(0, 0, 1), e), 60);
        BodyState state = Read(simulation, First, 60);
        Near(V(0, 0.5 / 0.8, 60), state.Position, 1e-6);
        Assert.Equal(V(0, 0, 1), state.Velocity);
        Assert.InRange(simulation.EventsProcessed, 3, 5000);
        Assert.Equal(SimTime.MaxValue, simulation.Horizon);
    }

    [Fact]
    public void Corner_BallThrownIntoIt_ComesToRestInFiniteEvents()
    {
        Scene scene = new SceneBuilder("corner").AddPlane("x", V(1, 1, 0), V(0), 0.5).AddPlane("y", V(-1, 1, 0.25), V(0), 0.5).AddPlane("z", V(0, 1, -1), V(0), 0.5)
            .AddBody("ball", Ball(0.25), V(0.1, 2, -0.1), V(1, 0, 0.5)).Build();
        Simulation simulation = Run(scene, 60);
        BodyState state = Read(simulation, First, 60);
        Assert.Equal(MotionLaw.Resting, state.Motion);
        Assert.InRange(simulation.EventsProcessed, 3, 10_000);
        Assert.All(simulation.Scene.Planes, plane => Near(0, plane.Gap(state.Position, 0.25), 1e-6));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(0.5)]
    public void Floor_AndWall_CarryASlidingBallAwayAgain(double e)
    {
        Scene scene = new SceneBuilder("wall").AddPlane("floor", Vector3D.Up, V(0), 0.5).AddPlane("wall", V(-1), V(2.5), e)
            .AddBody("ball", Ball(), V(0, 0.5), V(2)).Build();
        Simulation simulation = Run(scene, 3);
        BodyState state = Read(simulation, First, 3);
        Assert.Equal(MotionLaw.Sliding, state.Motion);
        Near(V(-2 * e), state.Velocity, 1e-15);
        Near(V(2 - (4 * e), 0.5), state.Position, 1e-11);
        Near(1, Assert.Single(Impacts(simulation, First), impact => impact.Key.Time > At(0.5)).Key.Time.ToSeconds(), 1e-12);
    }

    [Fact]
    public void Rest_HitByAnotherBody_WakesAtThatTick()
    {
        Scene scene = new SceneBuilder("wake").AddPlane("floor", Vector3D.Up, V(0), 0.5)
            .AddBody("sleeper", Ball(), V(0, 0.5)).AddBody("runner", Ball(), V(-3, 0.5), V(2)).Build();
        Simulation simulation = Run(scene, 3);
        SimTime hit = Impacts(simulation, First)[^1].Key.Time;
        Near(1, hit.ToSeconds(), 1e-12);
        Assert.Equal(MotionLaw.Resting, Read(simulation, First, hit - SimDuration.OneTick).Motion);
        Near(V(2), Read(simulation, First, 3).Velocity, 1e-15);
        Assert.Equal(MotionLaw.Resting, Read(simulation, Second, 3).Motion); // all its motion went over
    }

    [Fact]
    public void Rest_JammedFromAbove_StaysOnItsSupport()
    {
        const double d = 1e-7;
        Scene scene = new SceneBuilder("hammer").WithContactTolerance(d).AddPlane("floor", Vector3D.Up, V(0), 0.5)
            .AddBody("anvil", Ball(e: 0.3), V(0, 0.5)).AddBody("hammer", Ball(mass: 3, e: 0.3), V(0, 3), V(0, -5)).Build();
        Simulation simulation = Run(scene, 1);
        Assert.All(Enumerable.Range(0, 1001), i => Assert.True(MinGap(simulation, At(i / 1000.0)) > -2 * d));
        Near(0.5, Read(simulation, First, 1).Position.Y, 2 * d);
    }

    [Theory]
    [InlineData(0, 2, MotionLaw.Ballistic)]
    [InlineData(2, 0, MotionLaw.Sliding)]
    [InlineData(0, 0, MotionLaw.Resting)]
    public void Impulse_OnARestingBody_DoesWhatItsDirectionSays(double x, double y, MotionLaw expected)
    {
        Simulation simulation = Run(Drop(0, 0.5), 1);
        simulation.Submit(ExternalEvent.Impulse(At(2), 1, 1, First, V(x, y)));
        simulation.AdvanceTo(At(2.1));
        BodyState state = Read(simulation, First, 2);
        Assert.Equal(expected, state.Motion);
        Assert.Equal(V(x, y), state.Velocity);
    }

    [Fact]
    public void Impulse_IntoTheFloor_BouncesAtOnceWithTheRestitution()
    {
        Simulation simulation = Run(Drop(0, 0.5), 1);
        simulation.Submit(ExternalEvent.Impulse(At(2), 1, 1, First, V(0, -4)));
        simulation.AdvanceTo(At(2));
        Assert.Equal(V(0, 2), Read(simulation, First, 2).Velocity);
    }

    private static Scene Slope(MotionLaw flight) => new SceneBuilder("slope").AddPlane("slope", LeftSlope, V(0), 0.5)
        .AddBody("ball", Ball(flight: flight), LeftSlope * 0.5, V(0, 0, 2)).Build();

    private static Scene Groove(Vector3D position, Vector3D velocity, double e = 0.5) => new SceneBuilder("groove")
        .AddPlane("left", LeftSlope, V(0), e).AddPlane("right", RightSlope, V(0), e).AddBody("ball", Ball(), position, velocity).Build();
}
