using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Behavior;

/// <summary>A body whose motion cannot be followed leaves the world by an event of the fold, and the world of all others goes on.</summary>
public sealed class LostBodyTests
{
    private static readonly CollisionFilter Ghost = new(1, 0);

    /// <summary>A force that follows the spin is told at the rate that the spin gives it, not at none.</summary>
    [Fact]
    public void BallUnderTheMagnusForce_ThatGlancesOffARoughWall_IsToldWithItsRate()
    {
        Scene scene = new SceneBuilder("lift").WithGravity(Vector3D.Zero).AddForce(Force.Magnus("lift", 0.5), out ForceSet lift).AddPlane("wall", Vector3D.Up, 0)
            .AddBody("ball", new BodySpec(0.1, 1e-6, 0.5, friction: 0.5, forces: lift), V(0, 0.5)).Build();
        Simulation world = new(scene);
        world.Submit(PlayerAction.SetVelocity(First, V(100, -100)).Stamp(At(0.01), 1, 1));
        world.AdvanceTo(At(1));
        LostBody lost = Assert.Single(world.LostBodies());
        Assert.Equal(LossReason.TooStiff, lost.Reason);
        Assert.Matches(@"'lift' \(Magnus\) acts at [1-9][0-9]{6,} 1/s", lost.ToString());
    }

    /// <summary>A player lets a stone fall through the planet, into the centre of its pull.</summary>
    [Fact]
    public void Filter_ThatLetsAStoneFallIntoTheCentreOfAPull_TakesOutTheStoneAlone()
    {
        Simulation world = Run(Planet(), 5, [ExternalEvent.SetFilter(At(0.1), 1, 1, First, Ghost)]);
        LostBody lost = Assert.Single(world.LostBodies());
        Assert.Equal((First, LossReason.TooStiff), (lost.Body, lost.Reason));
        Assert.InRange(lost.Position.Length, 0, 1e-4);
        Assert.Contains("'stone'", lost.ToString(), StringComparison.Ordinal);
        Assert.Contains("'pull' (Central)", lost.ToString(), StringComparison.Ordinal);
        Assert.False(world.TryRead(First, At(5), out _));
        Assert.True(world.TryRead(First, lost.Time - SimDuration.OneTick, out _));
        Assert.Equal(Read(Run(Planet(), 5), Second, 5), Read(world, Second, 5)); // of the moon no bit is other
        Assert.Empty(Run(Planet(), 5).LostBodies()); // the control: on the planet's ground
    }

    /// <summary>What is heard of late makes a loss, moves it, and undoes it, as any other event.</summary>
    [Theory]
    [InlineData(HealingMode.CausalCone)]
    [InlineData(HealingMode.FullRollback)]
    [InlineData(HealingMode.SyncTest)]
    public void Loss_HeardOfLate_HealsToTheSameBits(HealingMode mode)
    {
        ExternalEvent ghost = ExternalEvent.SetFilter(At(0.1), 1, 1, First, Ghost), lift = ExternalEvent.Impulse(At(0.2), 2, 1, First, V(0, 1));
        ExternalEvent back = ExternalEvent.SetFilter(At(0.3), 1, 2, First, default);
        foreach (ExternalEvent[] events in new[] { new[] { ghost }, [ghost, lift], [lift, ghost], [ghost, back], [back, lift, ghost] })
        {
            Simulation late = new(Planet(), new SimulationOptions(history: SimDuration.MaxValue, healing: mode));
            for (int n = 0; n < events.Length; n++)
            {
                late.AdvanceTo(At(3 + n));
                late.Submit(events[n]);
            }

            late.AdvanceTo(At(7));
            Simulation inTime = Run(Planet(), 7, events);
            Assert.Equal(inTime.StateHash(At(7)), late.StateHash(At(7)));
            Assert.Equal(inTime.EventHash(At(7)), late.EventHash(At(7)));
            Assert.Equal(events.Contains(back) ? 0 : 1, late.LostBodies().Count);
        }
    }

    [Fact]
    public void Snapshot_OfAWorldThatHasLostABody_GoesOnTheSame()
    {
        Simulation world = Run(Planet(), 5, [ExternalEvent.SetFilter(At(0.1), 1, 1, First, Ghost)]);
        Simulation joined = new(Planet(), world.Snapshot(At(4)), KeepAll);
        joined.AdvanceTo(At(5));
        Assert.Equal(world.StateHash(At(5)), joined.StateHash(At(5)));
        Assert.Equal(world.EventHash(At(5)), joined.EventHash(At(5)));
    }

    /// <summary>What falls along a slope without end and without friction gets too fast one day.</summary>
    [Fact]
    public void Slide_WithoutEnd_LeavesAtTheHighestSpeed()
    {
        const double Smallest = 1e-9;
        double highest = Limits.MaxSpeed(Smallest);
        Scene scene = new SceneBuilder("slope").WithSmallestRadius(Smallest).AddPlane("slope", V(1, 1), V(0), 0)
            .AddBody("ball", new BodySpec(0.5, 1, 0), V(0.5 * Math.Sqrt(2), 0)).Build();
        double when = highest / (Gravity / Math.Sqrt(2));
        Simulation world = Run(scene, when + 1);
        LostBody lost = Assert.Single(world.LostBodies());
        Assert.Equal(LossReason.TooFast, lost.Reason);
        Near(when, lost.Time.ToSeconds(), 1e-3);
        Near(highest, lost.Velocity.Length, 1e-6);
    }

    /// <summary>A body that sleeps on one that is lost wakes and falls.</summary>
    [Fact]
    public void Sleeper_OnABodyThatIsLost_Wakes()
    {
        // A medium so thick that at rest nothing shows of it, and that no step follows once the ball below is fast.
        Scene scene = new SceneBuilder("pile").WithContactTolerance(1e-3).AddForce(Force.QuadraticDrag("tar", 1e6), out ForceSet tar)
            .AddPlane("floor", Vector3D.Up, V(0), 0).AddBody("below", new BodySpec(0.5, 1e-3, 0, forces: tar), V(0, 0.5))
            .AddBody("above", new BodySpec(0.5, 1e-3, 0), V(0, 1.5)).Build();
        Simulation world = Run(scene, 2);
        Assert.Equal(MotionLaw.Resting, Read(world, Second, 2).Motion);
        world.Submit(ExternalEvent.Impulse(At(2), 1, 1, First, V(100)));
        world.AdvanceTo(At(5));
        LostBody lost = Assert.Single(world.LostBodies());
        Assert.Equal((First, LossReason.TooStiff), (lost.Body, lost.Reason));
        Near(0.5, Read(world, Second, 5).Position.Y, 1e-2); // on the floor
        Near(1.5, Read(Run(scene, 5), Second, 5).Position.Y, 1e-2); // the control
    }

    /// <summary>Rules hear of a loss with its reason, and may do something about it; those that do not listen for it hear of a removal.</summary>
    [Fact]
    public void Rules_HearOfALoss()
    {
        Listener rules = new("hears losses"), older = new Deaf();
        Simulation world = Run(Planet(rules), 5, [ExternalEvent.SetFilter(At(0.1), 1, 1, First, Ghost)]);
        Assert.Equal([(First, LossReason.TooStiff)], rules.Lost);
        Assert.Single(world.LostBodies());
        Run(Planet(older), 5, [ExternalEvent.SetFilter(At(0.1), 1, 1, First, Ghost)]);
        Assert.Equal([First], older.Removed);
    }

    /// <summary>Of what has gone rules still know what it was made of, so that they spawn another; of what others are not any more they do not.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Rules_ThatSpawnAnotherLikeTheOneLost_FindItsProperties(bool isLost)
    {
        Respawning rules = new();
        ExternalEvent act = isLost ? ExternalEvent.SetFilter(At(0.1), 1, 1, First, Ghost) : ExternalEvent.Remove(At(0.1), 1, 1, First);
        Simulation world = Run(Planet(rules), 5, [act]);
        BodyId again = Assert.Single(Enumerable.Range(0, world.BodyCount).Select(world.BodyAt), body => body.Sequence > 0);
        Assert.Equal(world.SpecOf(First), world.SpecOf(again));
        Assert.True(world.SpecOf(First).Radius > 0 && rules.SeenLater.Radius == 0);
        Simulation late = Run(Planet(new Respawning()), 5);
        late.Submit(act);
        late.AdvanceTo(At(5));
        Assert.Equal(world.StateHash(At(5)), late.StateHash(At(5)));
    }

    /// <summary>A scene's own body that cannot take its first step is the scene's fault, and told as before any world begins.</summary>
    [Fact]
    public void Body_ThatCannotBegin_IsRefusedWithTheScene()
    {
        Scene scene = new SceneBuilder("storm").AddForce(Force.QuadraticDrag("wind", 1, V(1e12)), out ForceSet wind)
            .AddBody("leaf", new BodySpec(0.1, 1e-3, 0, forces: wind), V(0)).Build();
        Assert.Contains("'leaf'", Assert.Throws<SimulationException>(() => new Simulation(scene)).Message, StringComparison.Ordinal);
    }

    private static Scene Planet(SceneRules? rules = null)
    {
        SceneBuilder builder = new SceneBuilder("planet").WithGravity(Vector3D.Zero).AddForce(Force.Central("pull", Vector3D.Zero, 20), out ForceSet pull)
            .AddStaticSphere("planet", Vector3D.Zero, 0.5).AddBody("stone", new BodySpec(0.1, 1, 0.5, forces: pull), V(0, 2))
            .AddBody("moon", new BodySpec(0.1, 1, 0.5, forces: pull), V(3), V(0, 2.58));
        return (rules is null ? builder : builder.WithRules(rules)).Build();
    }

    private sealed class Respawning() : GameRules("respawns", 1)
    {
        internal BodySpec SeenLater { get; private set; }

        public override bool HearsBodies => true;

        public override void OnRemoved(RuleWorld world, BodyId body)
        {
            world.Spawn(world.SpecOf(body), new Vector3D(0, 4, 0));
            world.SetTimer(1, SimDuration.FromSeconds(0.1));
        }

        public override void OnTimer(RuleWorld world, int timer) => SeenLater = world.SpecOf(First); // it is not there
    }

    private class Listener(string name) : GameRules(name, 1)
    {
        internal List<(BodyId Body, LossReason Why)> Lost { get; } = [];

        internal List<BodyId> Removed { get; } = [];

        public override bool HearsBodies => true;

        public override void OnRemoved(RuleWorld world, BodyId body) => Removed.Add(body);

        public override void OnLost(RuleWorld world, BodyId body, LossReason why)
        {
            Lost.Add((body, why));
            world.Tell(1, (int)why);
        }
    }

    private sealed class Deaf() : Listener("hears removals")
    {
        public override void OnLost(RuleWorld world, BodyId body, LossReason why) => base.OnRemoved(world, body);
    }
}
