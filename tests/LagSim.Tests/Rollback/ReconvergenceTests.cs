using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.LooseParts;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Rollback;

/// <summary>
/// When a rollback may end before its horizon: a late event has cut what two bodies did from one second on, they are struck again then, and
/// the push of the second at two seconds has not happened again yet.
/// </summary>
public sealed class ReconvergenceTests
{
    [Fact]
    public void TryReconverge_BothOnTheirPathsAgain_PutsBackWhatFollowsAndEndsTheRollback()
    {
        RewoundWorld world = new(byOneImpact: true);
        List<HealReport> reports = [];
        world.Rewinder.Healed += reports.Add;
        Rewind(world);
        Strike(world);
        Assert.Equal((2, 2), (world.Count(0), world.Count(1)));
        Assert.True(world.Rewinder.TryReconverge(At(1), At(3)));
        Assert.Equal((2, 3), (world.Count(0), world.Count(1)));
        int last = world.Timelines.Last(1);
        Assert.Equal(Later.Key, world.Timelines.Key(last));
        Assert.True(world.Timelines.Segment(last).IsSameAs(Flight(2, V(3), V(0, 1))));
        Assert.Equal(At(3), world.Progress.SimulatedTo);
        Assert.False(world.Rollback.IsActive);
        Assert.Equal(new HealReport(At(0.5), At(3), 1, 2, 3, 0, At(1)), Assert.Single(reports));
    }

    /// <summary>What is put back has happened: the push is not due again, and nothing is scheduled for a time that lies behind.</summary>
    [Fact]
    public void TryReconverge_BothOnTheirPathsAgain_LeavesNothingToHappenTwice()
    {
        RewoundWorld world = new(byOneImpact: true);
        Rewind(world);
        Assert.NotEqual(EventLog.None, world.Log.Due(1));
        Strike(world);
        Assert.True(world.Scheduler.Count > 0);
        Assert.True(world.Rewinder.TryReconverge(At(1), At(3)));
        Assert.Equal(EventLog.None, world.Log.Due(1));
        Assert.True(world.Scheduler.Count == 0 || world.Scheduler.MinKey.Time > At(3));
    }

    /// <summary>Bodies that the impact strikes together stay together: a late event before it cuts both again.</summary>
    [Fact]
    public void TryReconverge_SharedEventThatIsPutBack_IsSharedAgain()
    {
        RewoundWorld world = new(byOneImpact: true);
        Rewind(world);
        Assert.True(world.Rewinder.TryReconverge(At(0.75), At(3)));
        Assert.Equal((2, 3), (world.Count(0), world.Count(1)));
        Rewind(world);
        Assert.Equal((1, 1), (world.Count(0), world.Count(1)));
    }

    [Theory]
    [InlineData(-1, 1, 3, true)] // the control
    [InlineData(-1 + 1e-15, 1, 3, false)] // one body is on another path, if only in the last bit
    [InlineData(-1, 1, 2.5, false)] // the world is not to be advanced to the horizon
    [InlineData(-1, 0.25, 3, false)] // not all of that instant is done
    [InlineData(-1, 3, 3, false)] // that is the horizon: there is nothing to put back
    public void TryReconverge_WhatMustHold_IsAllAsked(double speed, double at, double until, bool isReached)
    {
        RewoundWorld world = new(byOneImpact: true);
        Rewind(world);
        Strike(world, speed);
        Assert.Equal(isReached, world.Rewinder.TryReconverge(At(at), At(until)));
        Assert.Equal(!isReached, world.Rollback.IsActive);
        Assert.Equal(isReached ? 3 : 2, world.Count(1));
    }

    /// <summary>A second late event while the world heals the first: what was cut earlier is not kept.</summary>
    [Fact]
    public void TryReconverge_SecondLateEventMeanwhile_IsNot()
    {
        RewoundWorld world = new(byOneImpact: true);
        Rewind(world);
        world.Rewinder.Mark(1, Key(0.75, EventKind.SetVelocity, 1));
        Strike(world);
        Assert.False(world.Rewinder.TryReconverge(At(1), At(3)));
        Assert.Equal(2, world.Count(1));
    }

    /// <summary>The impacts that a rollback cuts are told only if they do not come back.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Observer_IsToldOfTheImpactsThatCutAndDoNotComeBack(bool comesBack)
    {
        RewoundWorld world = new(byOneImpact: true);
        CutImpacts told = new();
        world.Reconvergence.Observer = told;
        Rewind(world);
        if (comesBack)
        {
            Assert.True(world.Rewinder.TryReconverge(At(0.75), At(3)));
        }
        else
        {
            world.Progress.SimulatedTo = At(3);
            world.Rewinder.EndIfDone();
        }

        Assert.Equal(comesBack ? 0 : 2, told.Count);
    }

    private static void Rewind(RewoundWorld world) => world.Rewinder.Mark(0, Key(0.5, EventKind.SetVelocity));

    /// <summary>The event loop comes to one second: the two are struck as before, or the first is thrown back at another speed.</summary>
    private static void Strike(RewoundWorld world, double speed = -1)
    {
        EventKey impact = new(At(1), 0, EventKind.Impact, First, Second, 0, 0);
        world.Timelines.Append(0, First, impact, Flight(1, V(1), V(speed)), default);
        world.Timelines.Append(1, Second, impact, Flight(1, V(2), V(1)), default);
        Span<int> both = [0, 1];
        world.Timelines.Join(both);
        world.Rollback.Cursor = impact;
        world.Progress.SimulatedTo = At(1);
    }

    private sealed class CutImpacts : IImpactObserver
    {
        internal int Count { get; private set; }

        public void OnContact(in EventKey impact, in ImpactContact contact)
        {
        }

        public void OnCut(in EventKey impact) => Count++;
    }
}
