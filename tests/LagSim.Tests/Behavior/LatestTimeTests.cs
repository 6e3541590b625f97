using System;
using LagSim.Events;
using LagSim.Scenes;
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

    private static Scene World(bool inFlight = false)
    {
        SceneBuilder builder = new SceneBuilder("long").AddBody("a", new BodySpec(0.2, 1, 0.5), new Vector3D(0, 1, 0));
        return (inFlight ? builder.WithGravity(default) : builder.AddPlane("floor", Vector3D.Up, 0)).Build();
    }
}
