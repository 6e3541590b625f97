using LagSim.Events;
using LagSim.Hosting;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Budgets;

/// <summary>
/// Players pay for what is counted, not for what the clock says: on a machine that is busy with other things the same actions cost the same.
/// </summary>
public sealed class WorkLedgerClockTests
{
    private const byte Player = 1;

    /// <summary>
    /// A machine that gives this thread a thousandth of what it is thought to do. By the clock a player is far beyond the usual budget; by
    /// the count it is where it is on an idle machine.
    /// </summary>
    [Fact]
    public void ChargedTo_OnAStarvedMachine_IsWhatItIsOnAnIdleOne()
    {
        WorkLedger idle = Play(null);
        WorkLedger starved = Play(new BusyClock(SimDuration.FromMilliseconds(3)));
        Assert.Equal(idle.ChargedTo(Player), starved.ChargedTo(Player));
        Assert.Equal(idle.Total, starved.Total);
        Assert.InRange(idle.ChargedTo(Player), 100, 10_000);
        Assert.True(starved.SecondsFor(Player) > 0.12, $"{starved.SecondsFor(Player)} s");
        Assert.Equal(0, idle.SecondsFor(Player));
    }

    /// <summary>
    /// A step ends once it took as long as it may, whatever one event of it took: with events that take 60 ms each, a step of 0.1 s has two. The
    /// control: by the count alone it has them all.
    /// </summary>
    [Theory]
    [InlineData(true, 2)]
    [InlineData(false, 32)]
    public void Step_OfEventsThatTakeLong_EndsByTheClock(bool hasClock, int events)
    {
        SceneBuilder builder = new SceneBuilder("drops").AddPlane("floor", Vector3D.Up, 0.0);
        for (int n = 0; n < 32; n++)
        {
            builder.AddBody($"ball {n}", new BodySpec(0.25, 1, 1), new Vector3D(2 * n, 1 + (0.001 * n), 0));
        }

        LiveWorld world = new(builder.Build(), new SimulationOptions())
        {
            Work = new WorkLedger(hasClock ? new BusyClock(SimDuration.FromMilliseconds(60)) : null) { MaxWorkPerStep = 100_000 },
        };
        world.Step(SimTime.FromSeconds(0.4));
        Assert.Equal(events, world.Simulation.EventsProcessed);
    }

    /// <summary>A clock that goes back, as no steady one does, takes nothing from what was told before.</summary>
    [Fact]
    public void SecondsFor_AClockThatGoesBack_IsNeverLess() =>
        Assert.Equal(0, Play(new BusyClock(SimDuration.FromMilliseconds(-3))).SecondsFor(Player));

    private static WorkLedger Play(IClock? clock)
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, 0.0).AddBody("ball", new BodySpec(0.25, 1, 0.9), new Vector3D(0, 2, 0)).Build();
        LiveWorld world = new(scene, new SimulationOptions(default, SimDuration.FromSeconds(1))) { Work = new WorkLedger(clock) };
        for (int n = 1; n <= 50; n++)
        {
            SimTime now = SimTime.FromSeconds(n * 0.1);
            world.Step(now);
            world.NoteLateEvent(Player);
            world.Submit(ExternalEvent.Impulse(now - SimDuration.FromSeconds(0.08), Player, (uint)n, BodyId.OfScene(0), new Vector3D(0, 1, 0)));
        }

        return world.Work;
    }

    /// <summary>A clock that goes on by so much between any two readings, as it does for a thread that another program keeps from its core.</summary>
    private sealed class BusyClock(SimDuration each) : IClock
    {
        private SimTime now = SimTime.FromSeconds(100);

        public SimTime Now => now += each;
    }
}
