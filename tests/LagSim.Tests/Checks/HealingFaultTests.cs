using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Testing;
using LagSim.Tests.Faults;
using LagSim.Tests.Sessions;
using Xunit;

namespace LagSim.Tests.Checks;

/// <summary>Ways to heal that are known to be wrong: <c>check</c> catches each, shrinks what it caught, and lets the same session pass without it.</summary>
public sealed class HealingFaultTests
{
    [Fact]
    public void Run_CutsByTime_IsCaughtAndShrunkToTwoActionsOfOneTick()
    {
        CheckOptions options = new()
        {
            Sessions = 1,
            Seed = 2,
            Strategy = "full-rollback",
            PrepareSession = static (_, session) => session.Put(new FaultyEngineParts { CutsByTime = true }),
        };
        CheckReport report = Run(options);
        CheckFailure failure = Assert.Single(report.Failures);
        Assert.True(failure.Least.Actions.Count == 2 && failure.Least.Bodies.Count <= 2, failure.Command);
        Assert.StartsWith("lagsim check --seed 2 --sessions 1 --strategy full-rollback --bodies ", failure.Command, StringComparison.Ordinal);
        AssertLeast(failure.Least, options);
        CheckCase least = new(2, options with { Bodies = failure.Least.Bodies, Events = failure.Least.Actions });
        Assert.Single(least.ActionIndices.Select(i => least.Actions[i].AtSeconds).Distinct());

        // What it names plays again to the same; without the fault it does not fail.
        CheckOptions again = options with { Bodies = failure.Least.Bodies, Events = failure.Least.Actions, ShrinkingPlays = 0 };
        Assert.Equal(failure.Least.Difference, Run(again).Failures.Single().Whole.Difference);
        Assert.Empty(Run(again with { PrepareSession = null }).Failures);
    }

    private static void AssertLeast(CheckOutcome least, CheckOptions options)
    {
        foreach (int action in least.Actions)
        {
            Assert.Null(Failure(least.Bodies, [.. least.Actions.Where(d => d != action)]));
        }

        foreach (int body in least.Bodies)
        {
            Assert.True(least.Bodies.Count == 1 || Failure([.. least.Bodies.Where(b => b != body)], least.Actions) is null);
        }

        string? Failure(IReadOnlyList<int> bodies, IReadOnlyList<int> actions) =>
            CheckSession.Play(
                least.Seed, options with { Bodies = bodies, Events = actions }, TestContext.Current.CancellationToken).Failure;
    }

    [Fact]
    public void Run_OperandsSwappedOnOnePeer_IsCaughtThere()
    {
        CheckOptions options = new()
        {
            Sessions = 4,
            ShrinkingPlays = 0,
            PrepareSession = static (peer, session) => session.Put(new FaultyEngineParts { SwapsOperands = peer == 1 }),
        };
        CheckReport report = Run(options);
        Assert.NotEmpty(report.Failures);
        Assert.All(report.Failures, f => Assert.True(f.Whole.Difference is null || f.Whole.Difference.Peer == 1));
        FirstDifference first = report.Failures.Select(f => f.Whole.Difference).First(d => d is not null)!;
        Assert.Equal(EventKind.Impact, first.ExpectedKey!.Value.Kind);
        Assert.NotEqual((first.ExpectedKey, first.Expected.Position), (first.ActualKey, first.Actual.Position));
    }

    [Theory]
    [InlineData(HealingFault.ForgetsThePast, 3u)]
    [InlineData(HealingFault.OverlooksBodiesAhead, 4u)]
    [InlineData(HealingFault.GivesUpByBody, 27u)]
    [InlineData(HealingFault.DropsEvents, 2u)]
    [InlineData(HealingFault.LeavesSleepers, 29u)]
    [InlineData(HealingFault.CutsByTime, 2u)]
    [InlineData(HealingFault.LeavesWhoRests, 29u)]
    [InlineData(HealingFault.CutsMembersAlone, 4u)]
    [InlineData(HealingFault.ForgetsNearMisses, 4u)]
    [InlineData(HealingFault.ForgetsBodiesMovedOn, 357u)]
    internal void Run_HealingInAWayKnownToBeWrong_IsCaughtByItsSeed(HealingFault fault, uint seed)
    {
        // The seeds that docs/HEALING.md names.
        CheckOptions options = new() { Sessions = 1, Seed = seed, ShrinkingPlays = 0 };
        options = options with { PrepareSession = (_, session) => session.Put(Faulty(fault)) };
        CheckOutcome failed = Assert.Single(Run(options).Failures).Whole;
        Assert.True(failed.DifferingBits > 0 && failed.Difference is not null, failed.Failure);
    }

    /// <summary>Crossings of sensors count in the hashes that peers compare.</summary>
    [Theory]
    [InlineData(HealingFault.None, 0)]
    [InlineData(HealingFault.LeavesCrossings, 1)]
    internal void Run_CrossingsHealedInAWayKnownToBeWrong_IsCaught(HealingFault fault, int failures)
    {
        CheckOptions options = new() { Sessions = 1, Seed = 7, ShrinkingPlays = 0 };
        CheckReport report = Run(options with { PrepareSession = (_, session) => session.Put(Faulty(fault)) });
        Assert.Equal(failures, report.Failures.Count);
        Assert.True(failures > 0 || report.Outcomes.Single().Met.Crossings);
    }

    [Theory]
    [InlineData(2u)]
    [InlineData(3u)]
    [InlineData(4u)]
    [InlineData(29u)]
    [InlineData(105u)]
    [InlineData(357u)]
    [InlineData(20_176u)] // a hand that gave an impulse of less than a tick, in a copy
    public void Run_SameSeedWithoutAFault_Passes(uint seed) =>
        Assert.Empty(Run(new CheckOptions { Sessions = 1, Seed = seed, ShrinkingPlays = 0 }).Failures); // it is the fault that is caught

    /// <summary>Every world collapses in the same way here, so that what differs is the heal.</summary>
    [Theory]
    [InlineData(HealingFault.None)]
    [InlineData(HealingFault.CollapsesWithWhoTouches)]
    internal void Run_CollapseThatTakesInWhoTouches_IsSeenToHealWrong(HealingFault fault)
    {
        CheckOptions options = new()
        {
            Sessions = 1,
            Seed = 21_288,
            ShrinkingPlays = 0,
            PrepareSession = (_, session) => session.Put(Faulty(fault)),
            PrepareAlone = alone => alone.WithParts(Faulty(fault)),
        };
        Assert.Equal(fault == HealingFault.None ? 0 : 1, Run(options).Failures.Count);
    }

    [Theory]
    [InlineData(true, 44)]
    [InlineData(false, 35)]
    public void Run_PeriodicBoxOrOrbits_PassesAndCatchesAFault(bool isBox, ulong seed)
    {
        CheckOptions options = new() { Sessions = 1, Seed = seed, ShrinkingPlays = 0 };
        CheckReport right = Run(options);
        Assert.Empty(right.Failures);
        Assert.Equal((isBox ? 1 : 0, isBox ? 0 : 1), (right.SessionsThatMet(m => m.PeriodicBox), right.SessionsThatMet(m => m.ClosedOrbit)));
        CheckReport wrong = Run(options with { PrepareSession = static (_, session) => session.Put(Faulty(HealingFault.ForgetsThePast)) });
        Assert.True(Assert.Single(wrong.Failures).Whole.DifferingBits > 0);
    }

    private static FaultyEngineParts Faulty(HealingFault fault) => new() { Healing = fault };

    private static CheckReport Run(CheckOptions options) => InvariantCheck.Run(options, null, TestContext.Current.CancellationToken);
}
