using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Tests.Rules;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Behavior;

/// <summary>The latest instant of a world: what lies beyond is refused with a sentence, and the world goes on.</summary>
public sealed class LatestTimeTests
{
    private static readonly SimTime Latest = SimTime.FromTicks(7L << 60);
    private static readonly SimTime Start = SimTime.FromTicks(3L << 61);

    [Fact]
    public void Time_BeyondTheLatest_IsRefusedAndTheWorldGoesOn()
    {
        Simulation world = new(World(), new SimulationOptions(Start));
        ExternalEvent never = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0)).Stamp(SimTime.MaxValue, 1, 1);
        ExternalEvent soon = PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0)).Stamp(Start + SimDuration.FromSeconds(1), 1, 2);
        Assert.Contains("lasts until 7340032s", Assert.Throws<ArgumentOutOfRangeException>(() => world.AdvanceTo(SimTime.MaxValue)).Message);
        Assert.Contains("lasts until 7340032s", Assert.Throws<SceneException>(() => world.Submit(never)).Message);
        Assert.Contains("lasts until 7340032s", Assert.Throws<ArgumentOutOfRangeException>(() => world.SubmitForwarded(soon, SimTime.MaxValue)).Message);
        Assert.Equal(SubmitResult.Queued, world.Submit(soon));
        world.AdvanceTo(soon.Time);
        Assert.True(world.TookEffect(soon));
    }

    /// <summary>Up to there a world runs, whatever moves in it; a tick later it is refused.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void World_RunsUntilTheLatest(bool inFlight)
    {
        Simulation world = new(World(inFlight), new SimulationOptions(Start));
        world.AdvanceTo(Latest - SimDuration.FromSeconds(2));
        world.Submit(PlayerAction.Impulse(BodyId.OfScene(0), new Vector3D(0, 1, 0)).Stamp(Latest, 1, 1));
        world.AdvanceTo(Latest);
        Assert.Equal(Latest, world.SimulatedTo);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.AdvanceTo(Latest + SimDuration.OneTick));
    }

    /// <summary>A snapshot of any instant of a world can be continued, and one of a tick later cannot.</summary>
    [Fact]
    public void Snapshot_OfTheLastSecond_GoesOnToTheLatest()
    {
        Simulation world = new(World(), new SimulationOptions(Start));
        world.AdvanceTo(Latest);
        WorldSnapshot snapshot = world.Snapshot(Latest - SimDuration.FromSeconds(1));
        Simulation continued = new(World(), snapshot, new SimulationOptions());
        continued.AdvanceTo(Latest);
        Assert.Equal(world.StateHash(Latest), continued.StateHash(Latest));
        WorldSnapshot beyond = new(Start, Latest + SimDuration.OneTick, 0, snapshot.BodyArray);
        Assert.Contains("until 7340032s", Assert.Throws<SceneException>(() => _ = new Simulation(World(), beyond, new SimulationOptions())).Message);
    }

    /// <summary>A timer that is due at the latest instant is called there; one that would be due after it is set, and never due. So rules that
    /// set the same one again and again end no world, wherever it begins.</summary>
    /// <param name="start">When the world begins, in units of 2^20 s.</param>
    /// <param name="calls">How often the timer is due.</param>
    [Theory]
    [InlineData(0, 7)]
    [InlineData(6, 1)]
    [InlineData(-1, 7)]
    public void Timer_ThatIsDueAfterTheLatest_NeverComesAndEndsNothing(int start, int calls)
    {
        GivenRules rules = new()
        {
            Start = w => w.SetTimer(1, RuleWorld.MaxDelay),
            Timer = (w, timer) =>
            {
                w.State<GivenState>().Count++;
                w.SetTimer(timer, RuleWorld.MaxDelay);
            },
        };
        SimTime until = start < 0 ? Latest - SimDuration.OneTick : Latest; // as long as a duration can be
        Scene scene = new SceneBuilder("timers").WithGravity(default).AddBody("a", new BodySpec(0.2, 1, 0.5), default).WithRules(rules).Build();
        Simulation world = new(scene, new SimulationOptions(SimTime.FromTicks((long)start << 60)));
        world.AdvanceTo(until);
        Assert.True(world.TryReadRules(until, out GivenState state));
        Assert.Equal(calls, state.Count);
        Assert.Equal(1, StateLayout.Timers(world.Engine.Rules!.Current.Bytes));
        Simulation continued = new(scene, world.Snapshot(until), new SimulationOptions());
        continued.AdvanceTo(until);
        Assert.Equal(world.StateHash(until), continued.StateHash(until));
    }

    private static Scene World(bool inFlight = false)
    {
        SceneBuilder builder = new SceneBuilder("long").AddBody("a", new BodySpec(0.2, 1, 0.5), new Vector3D(0, 1, 0));
        return (inFlight ? builder.WithGravity(default) : builder.AddPlane("floor", Vector3D.Up, 0)).Build();
    }
}
