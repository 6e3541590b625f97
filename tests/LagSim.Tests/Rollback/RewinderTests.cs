using System.Collections.Generic;
using LagSim.Events;
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
        RewoundWorld world = new(byOneImpact);
        world.Rewinder.Mark(0, Early);
        Assert.Equal(1, world.Count(0));
        Assert.Equal(byOneImpact ? 1 : 3, world.Count(1));
        Assert.Equal(byOneImpact, world.Rollback.HasTouched(1));
        Assert.Equal(byOneImpact ? 3 : 1, world.Rollback.SegmentsCut);
        Assert.Equal(At(0.5) - SimDuration.OneTick, world.Progress.SimulatedTo);
    }

    [Fact]
    public void Mark_AfterTheImpact_LeavesIt()
    {
        RewoundWorld world = new(byOneImpact: true);
        world.Rewinder.Mark(0, Key(1.5, EventKind.SetVelocity));
        Assert.Equal(2, world.Count(0));
        Assert.Equal(3, world.Count(1));
        Assert.False(world.Rollback.HasTouched(1));
    }

    /// <summary>Keys are compared and not times: at the tick of an impact a push precedes it, and the end of a step follows.</summary>
    [Theory]
    [InlineData(EventKind.SetVelocity, 1)]
    [InlineData(EventKind.StepEnd, 2)]
    public void Mark_AtTheTickOfTheImpact_CutsItIfTheEventPrecedesIt(EventKind kind, int left)
    {
        RewoundWorld world = new(byOneImpact: true);
        world.Rewinder.Mark(0, Key(1, kind));
        Assert.Equal(left, world.Count(0));
    }

    /// <summary>A full rollback cuts all bodies at the key, whether or not they shared an impact.</summary>
    [Fact]
    public void Mark_InAFullRollback_CutsAllBodies()
    {
        RewoundWorld world = new(byOneImpact: false, HealingMode.FullRollback);
        world.Rewinder.Mark(0, Early);
        Assert.Equal(1, world.Count(1));
        Assert.True(world.Rollback.HasTouched(1));
    }

    [Fact]
    public void Mark_BeforeAnImpact_HasItPredictedAgain()
    {
        RewoundWorld world = new(byOneImpact: true);
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
        RewoundWorld world = new(byOneImpact);
        Assert.Equal(EventLog.None, world.Log.Due(1));
        world.Rewinder.Mark(0, Early);
        int due = world.Log.Due(1);
        Assert.Equal(byOneImpact, due != EventLog.None && world.Log.Key(due) == Later.Key);
    }

    [Fact]
    public void EndIfDone_OnceTheWorldIsWhereItWas_ReportsTheRollbackOnce()
    {
        RewoundWorld world = new(byOneImpact: true);
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
}
