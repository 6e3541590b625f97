using System.Collections.Generic;
using LagSim.BroadPhase;
using LagSim.Collisions;
using LagSim.Events;
using LagSim.Rollback;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rollback;

/// <summary>
/// What a late event for the first of two bodies cuts. Both are struck at one second, the second is pushed at two, and all is simulated to
/// three.
/// </summary>
public sealed class RewinderTests
{
    private static readonly EventKey Early = Key(0.5, EventKind.SetVelocity);

    /// <summary>An impact that no longer happens is cut from all that it struck, and so is what they did since.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Mark_BeforeAnImpact_CutsTheOtherTooIfItWasTheImpactOfBoth(bool byOneImpact)
    {
        World world = new(byOneImpact);
        world.Rewinder.Mark(0, Early);
        Assert.Equal(1, Count(world.Timelines, 0));
        Assert.Equal(byOneImpact ? 1 : 3, Count(world.Timelines, 1));
        Assert.Equal(byOneImpact, world.Rollback.HasTouched(1));
        Assert.Equal(byOneImpact ? 3 : 1, world.Rollback.SegmentsCut);
        Assert.Equal(At(0.5) - SimDuration.OneTick, world.Progress.SimulatedTo);
    }

    [Fact]
    public void Mark_AfterTheImpact_LeavesIt()
    {
        World world = new(byOneImpact: true);
        world.Rewinder.Mark(0, Key(1.5, EventKind.SetVelocity));
        Assert.Equal(2, Count(world.Timelines, 0));
        Assert.Equal(3, Count(world.Timelines, 1));
        Assert.False(world.Rollback.HasTouched(1));
    }

    /// <summary>Keys are compared and not times: at the tick of an impact a push precedes it, and the end of a step follows.</summary>
    [Theory]
    [InlineData(EventKind.SetVelocity, 1)]
    [InlineData(EventKind.StepEnd, 2)]
    public void Mark_AtTheTickOfTheImpact_CutsItIfTheEventPrecedesIt(EventKind kind, int left)
    {
        World world = new(byOneImpact: true);
        world.Rewinder.Mark(0, Key(1, kind));
        Assert.Equal(left, Count(world.Timelines, 0));
    }

    /// <summary>A full rollback cuts all bodies at the key, whether or not they shared an impact.</summary>
    [Fact]
    public void Mark_InAFullRollback_CutsAllBodies()
    {
        World world = new(byOneImpact: false, HealingMode.FullRollback);
        world.Rewinder.Mark(0, Early);
        Assert.Equal(1, Count(world.Timelines, 1));
        Assert.True(world.Rollback.HasTouched(1));
    }

    [Fact]
    public void Mark_BeforeAnImpact_HasItPredictedAgain()
    {
        World world = new(byOneImpact: true);
        EventKey impact = world.Timelines.Key(world.Timelines.Last(0));
        Assert.Equal(0, world.Scheduler.Count);
        world.Rewinder.Mark(0, Early);
        Assert.True(world.Scheduler.TryGet(0, out EventKey first));
        Assert.True(world.Scheduler.TryGet(1, out EventKey second));
        Assert.Equal((impact, impact), (first, second));
    }

    /// <summary>The push at two seconds has been applied, and is to be applied again only if it was cut.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Mark_BeforeAnImpact_MakesTheEventsOfACutBodyDueAgain(bool byOneImpact)
    {
        World world = new(byOneImpact);
        Assert.Equal(EventLog.None, world.Log.Due(1));
        world.Rewinder.Mark(0, Early);
        int due = world.Log.Due(1);
        Assert.Equal(byOneImpact, due != EventLog.None && world.Log.Key(due) == Later.Key);
    }

    [Fact]
    public void EndIfDone_OnceTheWorldIsWhereItWas_ReportsTheRollbackOnce()
    {
        World world = new(byOneImpact: true);
        List<HealReport> reports = [];
        world.Rewinder.Healed += reports.Add;
        world.Rewinder.Mark(0, Early);
        world.Progress.SimulatedTo = At(3) - SimDuration.OneTick;
        world.Rewinder.EndIfDone();
        Assert.Empty(reports);
        Assert.True(world.Rollback.IsActive);
        world.Progress.SimulatedTo = At(3);
        world.Rewinder.EndIfDone();
        world.Rewinder.EndIfDone();
        Assert.Equal(new HealReport(At(0.5), At(3), 1, 2, 3, 0), Assert.Single(reports));
        Assert.False(world.Rollback.IsActive);
    }

    private static int Count(TimelineStore timelines, int slot)
    {
        int count = 0;
        for (int at = timelines.First(slot); at != TimelineStore.None; at = timelines.Next(at))
        {
            count++;
        }

        return count;
    }

    /// <summary>Two bodies, and the parts that a rewinder needs.</summary>
    private sealed class World
    {
        internal World(bool byOneImpact, HealingMode mode = HealingMode.CausalCone)
        {
            Scene scene = new SceneBuilder("empty").WithGravity(Floating).WithSmallestRadius(0.5).Build();
            BodyTable bodies = new(2);
            FreeFlights flights = new(scene.Gravity, scene.RestitutionThreshold, scene.Box);
            Timelines = new TimelineStore(default, newest: flights);
            for (int slot = 0; slot < 2; slot++)
            {
                flights.AddSlot(slot, 0.5);
                Log.AddSlot(slot);
                Scheduler.AddSlot(slot);
                Rollback.AddSlot(slot);
            }

            AddTwoStruck(bodies, Timelines, byOneImpact);
            Log.TryAdd(1, Later, Later.Key, forwarded: false);
            SegmentLookup view = new(Timelines, Rollback);
            CollisionPredictor collisions = Predictor(scene, bodies, Timelines, view);
            CollisionSearch search = new(bodies, Timelines, flights, scene.Surfaces, collisions, new StepMarks());
            AdaptiveBroadPhase broadPhase = new(scene, bodies, Timelines, bruteForceLimit: 2);
            broadPhase.Begin();
            EventPredictor predictor = new(bodies, Timelines, Log, Scheduler, Rollback, flights, broadPhase, search, view);
            predictor.Predict(0); // so that the broad phase knows them
            predictor.Predict(1);
            Reconvergence reconvergence = new(bodies, Timelines, Log, Scheduler, Progress, Rollback, broadPhase, predictor, new CutPaths());
            Rewinder = new Rewinder(bodies, Timelines, Log, Scheduler, Progress, Rollback, reconvergence, predictor, mode);
            Progress.SimulatedTo = At(3);
        }

        internal TimelineStore Timelines { get; }

        internal EventLog Log { get; } = new();

        internal EventScheduler Scheduler { get; } = new(2);

        internal RollbackState Rollback { get; } = new();

        internal Progress Progress { get; } = new(default, SimDuration.MaxValue, default);

        internal Rewinder Rewinder { get; }
    }
}
