using System;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.SceneFiles;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Tests.Determinism;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Hosting;

/// <summary>A world kept ahead of a clock, in virtual time, and the render snapshots of it.</summary>
public sealed class LiveWorldTests
{
    private static readonly SimulationOptions Kept = new(default, SimDuration.FromSeconds(1));

    [Fact]
    public void Step_WheneverDue_KeepsTheRenderSnapshotAheadOfTheClock()
    {
        LiveWorld world = new(RandomScene, Kept);
        SimTime now = At(0);
        for (int i = 0; i < 200; i++)
        {
            SimTime due = world.Step(now);
            RenderSnapshot snapshot = world.RenderSnapshots.Latest();
            Assert.True(snapshot.Covers(now) && snapshot.To > now, $"{now}: {snapshot.From} to {snapshot.To}");
            Assert.True(due > now);
            Assert.True(snapshot.Covers(SimTime.Min(due, At(1000))));
            now = SimTime.Min(due, now + SimDuration.FromSeconds(0.02));
        }

        Assert.Equal(0, world.LateSteps);
        Assert.Equal(SimDuration.Zero, world.MaxLateness);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    public void RenderSnapshot_AfterEventsLateAndRetracted_ReadsWhatTheSimulationReads(int seed)
    {
        (int compared, int different) = Follow(seed, publishes: true);
        Assert.True(compared > 1000, $"{compared}");
        Assert.Equal(0, different);
    }

    [Fact]
    public void RenderSnapshot_NotPublishedAfterARollback_IsSeenToDiffer()
    {
        Assert.True(Enumerable.Range(1, 12).Sum(seed => Follow(seed, publishes: false).Different) > 0);
    }

    /// <summary>Late events that come one a step, each at the last instant that was done, do not keep there a world whose steps may do next to nothing.</summary>
    [Fact]
    public void Step_WithALateEventBeforeEach_StillGetsOn()
    {
        LiveWorld world = new(RandomScene, Kept) { Work = new WorkLedger { MaxWorkPerStep = 1e-3 } };
        world.Step(At(0.5));
        SimTime before = world.Simulation.SimulatedTo;
        for (uint n = 1; n <= 20; n++)
        {
            world.Submit(ExternalEvent.SetVelocity(world.Simulation.SimulatedTo, 1, n, First, V(0, 1)));
            world.Step(At(0.5));
            Assert.True(world.IsBehind); // else the step had nothing left to do
            Assert.True(world.Simulation.SimulatedTo > before, $"still at {before} after event {n}");
            before = world.Simulation.SimulatedTo;
        }
    }

    [Fact]
    public void Step_WorldAtRest_IsNeverDueAgain()
    {
        LiveWorld world = new(Drop(0, 0.5), Kept);
        Assert.Equal(SimTime.MaxValue, world.Step(At(0)));
        long number = world.RenderSnapshots.Latest().Number;
        Assert.Equal(SimTime.MaxValue, world.Step(At(5000)));
        RenderSnapshot snapshot = world.RenderSnapshots.Latest();
        Assert.Equal(number, snapshot.Number); // nothing changed, nothing published
        Assert.True(snapshot.TryRead(First, At(5000), out BodyState state));
        Assert.Equal(MotionLaw.Resting, state.Motion);

        // The control: a push makes it move, and due.
        world.Submit(ExternalEvent.Impulse(At(5000), 1, 1, First, V(0, 3)));
        Assert.NotEqual(SimTime.MaxValue, world.Step(At(5000)));
        snapshot = world.RenderSnapshots.Latest();
        Assert.True(snapshot.Number > number && snapshot.Covers(At(5000.01)));
        Assert.True(snapshot.TryRead(First, At(5000.01), out state));
        Assert.Equal(MotionLaw.Ballistic, state.Motion);
    }

    [Fact]
    public void Step_TooLate_IsCountedAndMeasured()
    {
        LiveWorld world = new(Drop(1, 1), Kept);
        world.Step(At(0));
        SimTime horizon = world.Simulation.Horizon;
        world.Step(horizon + SimDuration.FromSeconds(0.25));
        Assert.Equal(1, world.LateSteps);
        Assert.Equal(SimDuration.FromSeconds(0.25), world.MaxLateness);
        Assert.True(world.RenderSnapshots.Latest().Covers(horizon + SimDuration.FromSeconds(0.25)));
    }

    [Fact]
    public void RenderSnapshot_UnknownBodyOrTime_IsNotRead()
    {
        LiveWorld world = new(Drop(1, 1), Kept);
        Assert.False(world.RenderSnapshots.Latest().TryRead(First, At(0), out _)); // before the first
        world.Step(At(0));
        RenderSnapshot snapshot = world.RenderSnapshots.Latest();
        Assert.True(snapshot.TryRead(First, At(0), out _));
        Assert.False(snapshot.TryRead(Second, At(0), out _));
        Assert.False(snapshot.TryRead(First, At(100), out BodyState state));
        Assert.Equal(MotionLaw.Absent, state.Motion);
        Assert.False(snapshot.TryRead(First, At(0) - SimDuration.OneTick, out _));
        Assert.Equal(1, snapshot.BodyCount);
        Assert.Equal(First, snapshot.BodyAt(0));
    }

    [Fact]
    public void Constructor_SpansOutOfRange_AreRefused()
    {
        Scene scene = Drop(1, 1);
        Assert.Throws<ArgumentOutOfRangeException>(() => new LiveWorld(scene, Kept, SimDuration.Zero));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LiveWorld(scene, Kept, SimDuration.FromSeconds(1.1)));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LiveWorld(scene, Kept, renderedPast: -SimDuration.OneTick));
        Assert.Throws<ArgumentOutOfRangeException>(() => new LiveWorld(scene, Kept, SimDuration.FromSeconds(1)));
        Assert.Throws<ArgumentNullException>(() => new LiveWorld(scene, null!));
    }

    [Fact]
    public void Step_MoreToDoThanAStepMay_StopsBetweenTwoInstantsAndGoesOn()
    {
        LiveWorld bounded = new(Rattle(1_000), Kept) { Effort = 9 * 500 };
        LiveWorld free = new(Rattle(1_000), Kept) { Effort = long.MaxValue };
        Assert.True(free.Step(At(0)) > At(0));
        Assert.False(free.IsBehind);
        Assert.True(free.Simulation.EventsProcessed > 5_000); // the control: without a bound all is done in one step

        int steps = 0;
        SimTime reached = At(0);
        do
        {
            long before = bounded.Simulation.EventsProcessed;
            SimTime due = bounded.Step(At(0));
            Assert.InRange(bounded.Simulation.EventsProcessed - before, 1, 500);
            Assert.Equal(bounded.IsBehind, due == At(0));
            Assert.Equal(bounded.Simulation.Horizon, bounded.RenderSnapshots.Latest().To); // no more than is there
            Assert.True(bounded.Simulation.SimulatedTo > reached);
            reached = bounded.Simulation.SimulatedTo;
            steps++;
        }
        while (bounded.IsBehind);

        Assert.True(steps > 10, $"{steps}");
        Assert.Equal(free.Simulation.SimulatedTo, bounded.Simulation.SimulatedTo);
        SameTimelines(free.Simulation, bounded.Simulation);
    }

    [Fact]
    public void Step_WorldThatFallsBehind_ShowsWhereItStandsAndCountsThatItIsLate()
    {
        LiveWorld world = new(Rattle(1_000), Kept) { Effort = 9 * 500 };
        for (int frame = 1; frame <= 10; frame++)
        {
            world.Step(At(0.1 * frame));
            RenderSnapshot snapshot = world.RenderSnapshots.Latest();
            Assert.True(world.IsBehind && snapshot.To < At(0.1 * frame) && snapshot.From <= snapshot.To);
            Assert.True(snapshot.TryRead(First, snapshot.To, out _));
            Assert.Equal(frame, world.LateSteps);
        }

        Assert.True(world.MaxLateness > SimDuration.FromSeconds(0.9));
    }

    [Fact]
    public void Submit_LateEventWithMoreToSimulateAgainThanAStepMay_IsFinishedByLaterSteps()
    {
        ExternalEvent late = ExternalEvent.SetVelocity(At(0.001), 1, 1, First, V(-999));
        LiveWorld bounded = new(Rattle(1_000), Kept);
        LiveWorld free = new(Rattle(1_000), Kept) { Effort = long.MaxValue };
        foreach (LiveWorld world in new[] { bounded, free })
        {
            do
            {
                world.Step(At(0));
            }
            while (world.IsBehind);

            world.Effort = Math.Min(world.Effort, 9 * 500);
            world.Effort = world == free ? long.MaxValue : world.Effort;
            world.Step(At(0));
            SimTime front = world.Simulation.SimulatedTo;
            Assert.Equal(SubmitResult.RolledBack, world.Submit(late));
            Assert.Equal(world == bounded, world.IsBehind);
            Assert.Equal(world == bounded, world.Simulation.SimulatedTo < front);
        }

        while (bounded.IsBehind)
        {
            bounded.Step(At(0));
        }

        SameTimelines(free.Simulation, bounded.Simulation);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void Step_HealOverManySteps_KeepsTheLastWholeRenderSnapshotUntilTheWorldHasCaughtUp(int seed)
    {
        // Pairs of opposite kicks at one instant: in one version of the world, whichever, the velocities add up to what they did.
        (LiveWorld world, Random random) = (new(BuiltInScenes.Gas(100), Kept) { Effort = 1 }, new(seed));
        SimTime now = At(0.9);
        Settle(world, now);
        Vector3D sum = Sum(world.RenderSnapshots.Latest(), now, 100);
        uint sequence = 0;
        int steps = 0, kept = 0, healed = 0;
        for (int round = 0; round < 5; round++)
        {
            for (int pair = 0; pair < 10; pair++)
            {
                SimTime stamp = now - SimDuration.FromSeconds(0.5 + (0.3 * random.NextDouble()));
                int first = random.Next(100);
                world.Submit(ExternalEvent.Impulse(stamp, 1, ++sequence, BodyId.OfScene(first), V(0.02, 0.01)));
                world.Submit(ExternalEvent.Impulse(stamp, 1, ++sequence, BodyId.OfScene((first + 1 + random.Next(99)) % 100), V(-0.02, -0.01)));
            }

            RenderSnapshot before = world.RenderSnapshots.Latest();
            SimTime shown = now + world.LookAhead;
            do
            {
                world.Step(now);
                RenderSnapshot snapshot = world.RenderSnapshots.Latest();
                Assert.True(snapshot.Covers(now) && snapshot.To >= shown, $"{snapshot.To}, and {shown} was shown before");
                Assert.True((Sum(snapshot, now, 100) - sum).Length < 1e-12);
                Assert.True((Sum(snapshot, snapshot.From, 100) - sum).Length < 1e-12);
                steps++;
                kept += ReferenceEquals(snapshot, before) && world.Simulation.SimulatedTo < shown ? 1 : 0;
            }
            while (world.IsBehind);

            healed += ReferenceEquals(world.RenderSnapshots.Latest(), before) ? 0 : 1;
            now += SimDuration.FromSeconds(0.1);
            Settle(world, now);
        }

        Assert.Equal(5, healed);
        Assert.True(kept > 10 && steps > kept, $"{kept} of {steps} steps");

        // The control: half a pair is seen.
        world.Submit(ExternalEvent.Impulse(now - SimDuration.FromSeconds(0.1), 1, ++sequence, First, V(0.02, 0.01)));
        Settle(world, now);
        Assert.True((Sum(world.RenderSnapshots.Latest(), now, 100) - sum).Length > 0.02);
    }

    /// <summary>A ball in a gap of 2 mm, which meets 500 times its speed in walls a second.</summary>
    private static Scene Rattle(double speed) => new SceneBuilder("rattle").WithGravity(Vector3D.Zero)
        .AddPlane("west", V(1), V(-0.501), 1).AddPlane("east", V(-1), V(0.501), 1).AddBody("ball", Ball(), V(0), V(speed)).Build();

    private static void Settle(LiveWorld world, SimTime now)
    {
        do
        {
            world.Step(now);
        }
        while (world.IsBehind);
    }

    /// <summary>The velocities of so many bodies, all of which are there, added up.</summary>
    private static Vector3D Sum(RenderSnapshot snapshot, SimTime time, int bodies)
    {
        Vector3D sum = Vector3D.Zero;
        for (int n = 0; n < bodies; n++)
        {
            Assert.True(snapshot.TryRead(BodyId.OfScene(n), time, out BodyState state), $"{n} at {time}");
            sum += state.Velocity;
        }

        return sum;
    }

    private static Scene RandomScene => new RandomWorld(3).Scene;

    /// <summary>Plays a world with events submitted late, twice and retracted, and compares render snapshots with the simulation at random times.</summary>
    private static (int Compared, int Different) Follow(int seed, bool publishes)
    {
        Random random = new(seed);
        RandomWorld drawn = new(seed);
        LiveWorld world = new(drawn.Scene, Kept, renderedPast: SimDuration.FromSeconds(0.3));
        ExternalEvent[] events = drawn.Events.OrderBy(_ => random.Next()).ToArray();
        int compared = 0, different = 0, next = 0;
        for (int frame = 0; frame < 75; frame++)
        {
            SimTime now = At(frame / 60.0);
            world.Step(now);
            if (frame % 5 == 4 && next < events.Length)
            {
                ExternalEvent external = events[next++];
                if (publishes)
                {
                    world.Submit(external);
                    if (random.Next(3) == 0)
                    {
                        world.Step(now);
                        world.Retract(external);
                    }

                    world.Step(now);
                }
                else
                {
                    SimTime to = world.Simulation.SimulatedTo;
                    world.Simulation.Submit(external);
                    world.Simulation.AdvanceTo(to);
                }
            }

            if (random.Next(3) == 0)
            {
                continue; // the reader misses some render snapshots
            }

            RenderSnapshot snapshot = world.RenderSnapshots.Latest();
            for (int k = 0; k < 8; k++)
            {
                SimTime last = SimTime.Min(snapshot.To, now + world.LookAhead);
                SimTime time = snapshot.From + SimDuration.FromTicks((long)(random.NextDouble() * (last - snapshot.From).Ticks));
                time = k switch { 0 => snapshot.From, 1 => last, _ => time };
                foreach (BodyId body in Bodies(world.Simulation))
                {
                    bool there = world.Simulation.TryRead(body, time, out BodyState expected);
                    bool shown = snapshot.TryRead(body, time, out BodyState actual);
                    compared++;
                    different += there == shown && expected.IsSameBits(actual) ? 0 : 1;
                }
            }
        }

        return (compared, different);
    }
}
