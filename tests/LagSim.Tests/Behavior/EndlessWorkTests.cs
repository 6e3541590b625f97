using System;
using System.Threading;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>Scenes that ask for more events than anyone can wait for, or fall for ever: they can be stopped, and end with a sentence.</summary>
[Trait("Time", "real")]
public sealed class EndlessWorkTests
{
    /// <summary>
    /// A row that touches in the first thousand ticks of time itself. What waits there as long as there is time ended a world with an overflow.
    /// </summary>
    [Theory]
    [InlineData(1e-13)]
    [InlineData(1e-12)]
    [InlineData(1e-11)]
    [InlineData(1e-10)]
    public void Row_ThatIsStruckInTheFirstNanosecond_GoesOn(double gap)
    {
        for (int balls = 2; balls < 11; balls++)
        {
            for (int restitution = 0; restitution <= 10; restitution++)
            {
                SceneBuilder builder = new SceneBuilder("row").AddPlane("floor", Vector3D.Up, 0);
                for (int n = 0; n < balls; n++)
                {
                    builder.AddBody($"{n}", new BodySpec(0.15, 1, restitution / 10.0), V(n * (0.3 + gap), 0.15), n == 0 ? V(0.1) : n == balls - 1 ? V(-0.1) : V(0));
                }

                Simulation world = new(builder.Build());
                world.AdvanceTo(At(0.1));
                Assert.Equal(At(0.1), world.SimulatedTo);
            }
        }
    }

    [Fact]
    public void AdvanceTo_Cancelled_StopsBetweenTwoInstantsAndWhatHappenedStands()
    {
        using CancellationTokenSource stop = new();
        int calls = 0;
        Scene scene = new SceneBuilder("tick").AddForce(Force.Supplied(new FunctionForce((_, _, _) =>
        {
            if (++calls == 400)
            {
                stop.Cancel(); // from another thread it would be at any moment
            }

            return Vector3D.Zero;
        }))).AddBody("x", Ball(flight: MotionLaw.RungeKutta4, force: 1), V(0), V(1)).Build();
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.MaxValue, cancellation: stop.Token));
        Assert.Throws<OperationCanceledException>(() => simulation.AdvanceTo(At(100)));
        Assert.InRange(simulation.SimulatedTo.ToSeconds(), 0.2, 1);
        Simulation whole = Run(scene, 1);
        Assert.Equal(whole.StateHash(simulation.SimulatedTo), simulation.StateHash(simulation.SimulatedTo));
        Assert.Equal(whole.EventHash(simulation.SimulatedTo), simulation.EventHash(simulation.SimulatedTo));
        Assert.Throws<OperationCanceledException>(() => simulation.AdvanceTo(At(100))); // and not: it has faulted
    }

    [Fact]
    public void Simulation_CancelledBeforeItBegins_IsNotMade()
    {
        Assert.Throws<OperationCanceledException>(() => new Simulation(Drop(1, 1), new SimulationOptions(cancellation: new CancellationToken(true))));
    }

    [Fact]
    public void Dispose_HostWhoseStepWouldNeverEnd_IsPrompt()
    {
        // A nanosecond from wall to wall: some 1e9 impacts a second, and 33 ms are to be simulated at once.
        using ManualResetEventSlim isAtWork = new();
        Scene scene = new SceneBuilder("rattle").WithGravity(Floating).AddPlane("left", V(1), V(0)).AddPlane("right", V(-1), V(1.001))
            .AddForce(Force.Supplied(new FunctionForce((t, _, _) =>
            {
                if (t > 1e-5)
                {
                    isAtWork.Set();
                }

                return Vector3D.Zero;
            })))
            .AddBody("tells", Ball(flight: MotionLaw.RungeKutta4, step: 1e-6, force: 1), V(0.5005, 10), V(0))
            .AddBody("ball", Ball(), V(0.5005), V(1e6)).Build();
        SimulationHost host = new(scene, new StopwatchClock());
        host.Start();
        Assert.True(isAtWork.Wait(TimeSpan.FromSeconds(30), TestContext.Current.CancellationToken));
        host.Dispose();
        Assert.NotNull(host.RenderSnapshot); // a step that is not interrupted goes on until the memory it may have is full, and has faulted
    }

    [Fact]
    public void AdvanceTo_MoreSegmentsThanAllowed_EndsWithASentence()
    {
        Scene scene = new SceneBuilder("rattle").WithGravity(Floating).AddPlane("left", V(1), V(0)).AddPlane("right", V(-1), V(1.001))
            .AddBody("ball", Ball(), V(0.5005), V(1)).Build();
        Simulation simulation = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(1), maxSegments: 500));
        simulation.AdvanceTo(At(0.4)); // the control: a thousand impacts a second, so far fewer than 500
        SimulationException failure = Assert.Throws<TimelinesFullException>(() => simulation.AdvanceTo(At(0.6)));
        Assert.Contains("500 segments", failure.Message, StringComparison.Ordinal);
        Simulation shorter = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(0.25), maxSegments: 500));
        shorter.AdvanceTo(At(10)); // as it advises: what lies behind the history makes room
    }

    [Theory]
    [InlineData(0)]
    [InlineData(-1)]
    public void Options_NoSegments_AreRefused(int segments)
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new SimulationOptions(maxSegments: segments));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(3)]
    [InlineData(-3)]
    public void FreeFall_ThatBecomesTooFast_LeavesTheWorldAtThatVeryInstant(double speed)
    {
        // A nanometre's tenth a tick is 110 m/s, and twice that what a fall may reach.
        Scene scene = new SceneBuilder("dust").AddBody("grain", Ball(1e-9), V(0), V(speed, speed)).Build();
        double limit = 0.2 * 1e-9 * (1L << 40);
        double t = (speed + Math.Sqrt((limit * limit) - (speed * speed))) / 9.81;
        Simulation simulation = new(scene, KeepAll);
        simulation.AdvanceTo(At(t - 1e-9));
        Assert.InRange(Read(simulation, First, t - 1e-9).Velocity.Length, limit * (1 - 1e-8), limit);
        simulation.AdvanceTo(At(t + 1e-9));
        LostBody lost = AssertTooFast(simulation);
        Assert.Contains("body 'grain'", lost.ToString(), StringComparison.Ordinal);
    }

    [Fact]
    public void Slide_ThatBecomesTooFast_LeavesToo()
    {
        Scene scene = new SceneBuilder("slope").AddPlane("slope", V(0.6, 0.8), V(0), 0).AddBody("grain", Ball(1e-9), V(0.6e-9, 0.8e-9)).Build();
        Assert.Equal(MotionLaw.Sliding, Read(Run(scene, 1), First, 1).Motion);
        AssertTooFast(Run(scene, 100));
    }

    [Theory]
    [InlineData(0.05, 0, 9.81 * (0.6 - (0.05 * 0.8)))] // slips
    [InlineData(0.5, 0, 9.81 * 0.6 * 5 / 7)] // rolls
    [InlineData(0.5, 0.001, 9.81 * (0.6 - (0.001 * 0.8)) * 5 / 7)] // against resistance
    public void DescentWithFriction_ThatBecomesTooFast_LeavesAtThatVeryInstant(double friction, double resistance, double acceleration)
    {
        Simulation world = new(Slope(friction, resistance, V(0)), KeepAll);
        double limit = 0.2 * 1e-9 * (1L << 40), t = limit / acceleration;
        world.AdvanceTo(At(t - 1e-6));
        Assert.InRange(Read(world, First, t - 1e-6).Velocity.Length, limit * (1 - 1e-6), limit);
        world.AdvanceTo(At(t + 1e-6));
        AssertTooFast(world);
    }

    [Theory]
    [InlineData(0.05)]
    [InlineData(0.5)]
    public void DescentWithFriction_AslantOfThePull_LeavesToo(double friction)
    {
        // It turns as it goes, so that each of its pieces ends for that; none is any the slower for it.
        Simulation world = new(Slope(friction, 0, V(0, 0, 1)), KeepAll);
        world.AdvanceTo(At(1000));
        AssertTooFast(world);
    }

    private static LostBody AssertTooFast(Simulation world)
    {
        LostBody lost = Assert.Single(world.LostBodies());
        Assert.Equal(LossReason.TooFast, lost.Reason);
        return lost;
    }

    private static Scene Slope(double friction, double resistance, Vector3D velocity) => new SceneBuilder("slope").WithSmallestRadius(1e-9)
        .AddPlane("slope", V(0.6, 0.8), V(0), 0).AddBody("ball", new BodySpec(0.5, 1, 0, friction: friction, rollingResistance: resistance), V(0.3, 0.4), velocity).Build();

    [Fact]
    public void Fall_OfAnOrdinaryBall_HasNoEnd()
    {
        Scene scene = new SceneBuilder("void").AddBody("ball", Ball(), V(0)).Build();
        Simulation simulation = Run(scene, 7e6); // nearly as far as a world lasts
        Near(-9.81 * 7e6, Read(simulation, First, 7e6).Velocity.Y, 1e-6);
        Assert.Equal(SimTime.MaxValue, simulation.Horizon);
    }

    [Fact]
    public void Read_AtTheEndOfTime_FromAStartLongBefore_DoesNotOverflow()
    {
        Simulation simulation = new(Drop(1, 0), new SimulationOptions(SimTime.FromTicks(-(3L << 61)), SimDuration.FromSeconds(1)));
        simulation.AdvanceTo(Limits.LatestTime);
        Assert.True(simulation.TryRead(First, Limits.LatestTime, out BodyState state));
        Assert.Equal(MotionLaw.Resting, state.Motion);
        Simulation falls = new(new SceneBuilder("void").AddBody("ball", Ball(), V(0), V(1)).Build(), new SimulationOptions(SimTime.FromTicks(-(3L << 61)), SimDuration.MaxValue));
        Assert.True(falls.TryRead(First, falls.Horizon, out state));
        Near(14680064, state.Position.X, 1e-6); // 2^63 + 3 * 2^61 ticks in seconds
    }
}
