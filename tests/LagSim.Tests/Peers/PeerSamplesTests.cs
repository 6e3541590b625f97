using LagSim.Harness.Experiments.Peers;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Peers;

public sealed class PeerSamplesTests
{
    private static readonly SimDuration Interval = SimDuration.FromMilliseconds(10);
    private static readonly SimDuration Timeout = SimDuration.FromMilliseconds(4);

    private readonly LiveWorld world = new(TestWorlds.Drop(5, 0.8), KeepAll, SimDuration.FromMilliseconds(33), SimDuration.FromMilliseconds(50));
    private readonly PeerSamples samples = new(new SampleGrid(At(0), Interval, 10), [First]);

    [Fact]
    public void Take_OnTime_ShowsEveryInstantAsItWas()
    {
        for (int n = 0; n < 10; n++)
        {
            Look((0.01 * (n + 1)) + 1e-6);
        }

        Assert.True(samples.IsComplete);
        for (int n = 0; n < 10; n++)
        {
            Assert.True(samples.IsShown(n));
            SameBits(Read(world.Simulation, First, At(0) + (Interval * (n + 1))), samples.State(n, 0));
        }
    }

    [Fact]
    public void Take_LateWithinTimeout_IsShown()
    {
        Look(0.0139);
        Assert.True(samples.IsShown(0));
        Assert.Equal(1, samples.Next);
    }

    [Fact]
    public void Take_LaterThanTimeoutWithANewPicture_HasStalled()
    {
        // What this render snapshot shows of that instant is not what was shown then.
        Look(0.0141);
        Assert.False(samples.IsShown(0));
        Assert.Equal(1, samples.Next);
    }

    [Fact]
    public void Take_LaterThanTimeoutWithThePictureOfTheLastLook_IsShown()
    {
        Look(0.010);
        Look(0.029, step: false);
        Assert.True(samples.IsShown(0) && samples.IsShown(1));
    }

    [Fact]
    public void Take_PictureThatEndsBeforeTheInstant_HasStalled()
    {
        world.Step(At(0));
        double end = world.Simulation.Horizon.ToSeconds(); // the ball hits the floor
        SampleGrid grid = new(At(end - 0.005), Interval, 2);
        PeerSamples late = new(grid, [First]);
        late.Take(world.RenderSnapshots.Latest(), grid.At(0), Timeout);
        Assert.False(late.IsShown(0));
        Assert.Equal(1, late.Next);
    }

    [Fact]
    public void Take_NoPicture_HasStalled()
    {
        samples.Take(null, At(0.1001), Timeout);
        Assert.True(samples.IsComplete);
        Assert.False(samples.IsShown(0) || samples.IsShown(9));
    }

    [Fact]
    public void Take_BeforeTheFirstInstant_TakesNothing()
    {
        Look(0.0099);
        Assert.Equal(0, samples.Next);
        Assert.Equal(At(0) + Interval, samples.NextTime);
    }

    [Fact]
    public void Take_OfAPeerThatShowsThePast_IsWhatWasThatMuchEarlierAndTheStartAtFirst()
    {
        SimDuration delay = SimDuration.FromMilliseconds(25);
        PeerSamples past = new(new SampleGrid(At(0), Interval, 10), [First], delay);
        world.Step(At(0.05));
        past.Take(world.RenderSnapshots.Latest(), At(0.0501), SimDuration.FromSeconds(1));
        for (int n = 0; n < 5; n++)
        {
            SimTime shown = SimTime.Max(At(0), At(0) + (Interval * (n + 1)) - delay);
            Assert.Equal(shown, past.ShownAt(At(0) + (Interval * (n + 1))));
            SameBits(Read(world.Simulation, First, shown), past.State(n, 0));
        }

        past.TakeAt(5, world.RenderSnapshots.Latest(), At(0.055));
        SameBits(Read(world.Simulation, First, At(0.055) - delay), past.State(5, 0));
    }

    [Fact]
    public void TakeSettled_AfterTheRun_ShowsWhatTheHistoryStillHas()
    {
        world.Step(At(0.2));
        world.Simulation.DropHistoryBefore(At(0.045));
        samples.TakeSettled(world.Simulation);
        for (int n = 0; n < 10; n++)
        {
            Assert.Equal(n >= 4, samples.IsShown(n)); // 0.05 s on
        }
    }

    [Fact]
    public void Distance_OfAPeerThatStalled_IsNoNumberAndCountsAsStalled()
    {
        Look(0.010);
        PeerSamples never = new(new SampleGrid(At(0), Interval, 10), [First]);
        never.Take(null, At(0.010), Timeout);
        Assert.True(double.IsNaN(PeerComparison.Distance([samples, never], 1, 0, out bool differs)));
        Assert.False(differs);
        Harness.Experiments.Metrics.PhaseErrors errors = PeerComparison.Errors([samples, never], new SampleGrid(At(0), Interval, 10), 1, 0, 1, null, At(0));
        Assert.Equal((0, 1), (errors.Before.ToStatistics().Samples, errors.Before.ToStatistics().StalledSamples));
    }

    [Fact]
    public void Distance_OfOneBit_IsSeenAsDiffering()
    {
        // Too small to move the body by a number that is not zero after rounding, but not the same.
        Simulation one = Run(TestWorlds.Drop(5, 0.8), 0.2);
        Scene scene = new SceneBuilder("drop").AddPlane("floor", Vector3D.Up, V(0), 1)
            .AddBody("ball", Ball(e: 0.8), V(0, 5.5), V(double.Epsilon)).Build();
        PeerSamples a = new(new SampleGrid(At(0), Interval, 3), [First]), b = new(new SampleGrid(At(0), Interval, 3), [First]);
        a.TakeSettled(one);
        b.TakeSettled(Run(scene, 0.2));
        Assert.InRange(PeerComparison.Distance([a, b], 1, 2, out bool differs), 0, 1e-300);
        Assert.True(differs);
        Assert.Equal(0, PeerComparison.Distance([a, a], 1, 2, out differs));
        Assert.False(differs);
    }

    [Fact]
    public void Distance_OfABodyThatOneDoesNotHave_DiffersAndIsNoDistance()
    {
        Simulation empty = Run(new SceneBuilder("empty").AddPlane("floor", Vector3D.Up, V(0), 1).Build(), 0.2);
        PeerSamples a = new(new SampleGrid(At(0), Interval, 3), [First]), b = new(new SampleGrid(At(0), Interval, 3), [First]);
        a.TakeSettled(Run(TestWorlds.Drop(5, 0.8), 0.2));
        b.TakeSettled(empty);
        Assert.Equal(0, PeerComparison.Distance([a, b], 1, 2, out bool differs));
        Assert.True(differs);
        Assert.Equal(0, PeerComparison.Distance([b, b], 1, 2, out differs));
        Assert.False(differs);
    }

    [Fact]
    public void Errors_WithAnEvent_PutEachInstantIntoItsPhase()
    {
        PeerSamples a = new(new SampleGrid(At(0), Interval, 10), [First]);
        a.TakeSettled(Run(TestWorlds.Drop(5, 0.8), 0.2));
        Harness.Experiments.Metrics.PhaseErrors errors = PeerComparison.Errors([a, a], new SampleGrid(At(0), Interval, 10), 1, 0, 10, At(0.03), At(0.05));
        Assert.Equal((2, 2, 6), (errors.Before.ToStatistics().Samples, errors.During.ToStatistics().Samples, errors.After.ToStatistics().Samples));
    }

    [Theory]
    [InlineData(-1, 0)]
    [InlineData(0, 0)]
    [InlineData(0.0099, 0)]
    [InlineData(0.0101, 1)]
    [InlineData(0.0999, 9)]
    [InlineData(0.1001, 10)]
    [InlineData(50, 10)]
    public void FirstAfter_AnyTime_IsTheFirstInstantLaterThanThat(double seconds, int expected)
    {
        SampleGrid grid = new(At(0), Interval, 10);
        Assert.Equal(expected, grid.FirstAfter(At(seconds)));
        Assert.True(expected == 10 || grid.At(expected) > At(seconds));
        Assert.True(expected == 0 || grid.At(expected - 1) <= At(seconds));
    }

    private void Look(double now, bool step = true)
    {
        if (step)
        {
            world.Submit(Events.ExternalEvent.SetVelocity(At(now + 1), 0, (uint)(now * 1e6), First, V(1))); // so that there is a new render snapshot
            world.Step(At(now));
        }

        samples.Take(world.RenderSnapshots.Latest(), At(now), Timeout);
    }
}
