using System;
using System.Linq;
using System.Threading;
using LagSim.Harness.Verification.Worlds;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;

namespace LagSim.Tests.Checks;

/// <summary>Random single worlds: what they promise holds, and the check sees what breaks it.</summary>
public sealed class WorldCheckTests
{
    [Fact]
    public void Run_WorldsOfAllKinds_NoneEndsNoBitDiffersNoPromiseIsBroken()
    {
        WorldReport report = Run(new WorldOptions { Worlds = 56, Seed = 1400 });
        Assert.True(report.Failures.Count == 0,
            string.Join(Environment.NewLine, report.Failures.Select(f => $"{f.Command} {f.Kind}: {f.Failure} {f.Difference}")));
        Assert.Equal(56, report.Outcomes.Count);
        Assert.All(report.Outcomes.GroupBy(o => o.Kind), kind => Assert.Equal(4, kind.Count()));

        // Else little was shown.
        Assert.True(report.Outcomes.Count(o => o.IsUnfinished || o.HasFullTimelines) <= 3);
        Assert.True(report.Outcomes.Sum(o => o.Acts) > 400 && report.Outcomes.Sum(o => o.ActsAtEvents) > 100);
        Assert.True(report.Outcomes.Sum(o => o.Meetings) > 30 && report.Outcomes.Sum(o => o.Compared) > 10_000);
    }

    /// <summary>Each way to heal that is known to be wrong gives some world other bits.</summary>
    [Theory]
    [InlineData(HealingFault.None, false)]
    [InlineData(HealingFault.ForgetsThePast, true)]
    [InlineData(HealingFault.DropsEvents, true)]
    [InlineData(HealingFault.CutsMembersAlone, true)]
    internal void Run_HealingInAWayKnownToBeWrong_IsSeenToDiffer(HealingFault fault, bool isSeen)
    {
        WorldReport report = Run(new WorldOptions
        {
            Worlds = 28,
            Seed = 1400,
            ShrinkingPlays = 0,
            PrepareLate = options => options.WithParts(new FaultyEngineParts { Healing = fault }),
        });
        Assert.Equal(isSeen, report.CountOf(WorldFailureKind.Differs) > 0);
    }

    /// <summary>
    /// Two players on one awake body: what changes within a contact step is followed only from the next one on. It made light balls
    /// faster without bound, and ended worlds.
    /// </summary>
    [Theory]
    [InlineData(2846)]
    [InlineData(7130)]
    public void Run_WhatChangesWithinAStepFollowedLate_IsSeenToGainEnergy(ulong seed)
    {
        WorldOptions options = new() { Worlds = 1, Seed = seed, MaxEvents = 20_000 };
        FaultyEngineParts late = new() { FollowsChangesLate = true };
        WorldOutcome failure = Assert.Single(Run(options with { PrepareOnTime = on => on.WithParts(late) }).Failures);
        Assert.Equal("energy", failure.Promise);
        Assert.InRange(failure.LeastActs.Count, 1, 3); // what is left of it is little
        Assert.Empty(Run(options).Failures);
    }

    /// <summary>A late spawn makes a member of a body that was asked for a collapse when it was none, in the same instant.</summary>
    [Fact]
    public void Run_CollapseThatALateEventBringsAbout_HasTheSameBits()
    {
        WorldOptions options = new() { Worlds = 1, Seed = 3_021_125, ShrinkingPlays = 0 };
        Assert.Empty(Run(options).Failures);
        FaultyEngineParts parts = new() { Healing = HealingFault.ForgetsNearMisses };
        Assert.Equal(WorldFailureKind.Differs, Assert.Single(Run(options with { PrepareLate = late => late.WithParts(parts) }).Failures).FailureKind);
    }

    /// <summary>A heal takes back that a rule puts a body elsewhere in the very instant in which another strikes it, and then a wall.</summary>
    [Fact]
    public void Run_BodyThatStaysWhereItWasStruck_HasTheSameBits()
    {
        WorldOptions options = new() { Worlds = 1, Seed = 9_101_567, ShrinkingPlays = 0 };
        Assert.Empty(Run(options).Failures);
        FaultyEngineParts parts = new() { Healing = HealingFault.LeavesStruckAgain };
        Assert.Equal(WorldFailureKind.Differs, Assert.Single(Run(options with { PrepareLate = late => late.WithParts(parts) }).Failures).FailureKind);
    }

    /// <summary>
    /// An event that is to come is taken back, and its body predicted again, as from now on; then a late one comes. (As from the last event
    /// on, the broad phase wanted a look at an instant that was over, and the heal that began there took the late event for done.)
    /// </summary>
    [Fact]
    public void Run_LateEventAfterOneThatWasTakenBack_TakesEffect() => Assert.Empty(Run(new WorldOptions { Worlds = 1, Seed = 9_023_183, ShrinkingPlays = 0 }).Failures);

    /// <summary>A hand strikes in a jam and lets go within the step; a snapshot of after that knows what the impact has left to the step.</summary>
    [Fact]
    public void Run_HandThatLetsGoWithinTheStepOfItsImpact_HasTheSameBits()
    {
        WorldOptions options = new() { Worlds = 1, Seed = 3_000_875, ShrinkingPlays = 0 };
        Assert.Empty(Run(options).Failures);
        Assert.Equal(WorldFailureKind.Differs, Assert.Single(Run(options with { PrepareSnapshot = Forgetful }).Failures).FailureKind);

        static WorldSnapshot Forgetful(WorldSnapshot s) =>
            new(s.Start, s.Time, s.EventHash, [.. s.Bodies.Select(b => b.Contacts.Length > 0 ? WithoutSolved(b) : b)], s.RuleState);

        static BodySnapshot WithoutSolved(BodySnapshot b) => new(
            b.Id, b.Spec, b.Opened, b.Law, b.Epoch, b.End, b.Position, b.Velocity, b.Acceleration, spin: b.Spin, spinRate: b.SpinRate, centre: b.Centre,
            stillSince: b.StillSince, contacts: [.. b.Contacts.ToArray().Select(c => new PersistentContact(c.Partner, c.Surface, c.Holds, c.Push, c.Turn))],
            filter: b.Filter, players: b.Players);
    }

    /// <summary>Rows without weight in which one is put into others and comes out: what leaves took momentum from nothing.</summary>
    [Theory]
    [InlineData(1001051)]
    [InlineData(1001527)]
    public void Run_WhatIsPushedOut_KeepsMomentum(ulong seed)
    {
        WorldOptions options = new() { Worlds = 1, Seed = seed, ShrinkingPlays = 0 };
        Assert.Empty(Run(options).Failures);
        FaultyEngineParts parts = new() { Rules = new FaultySolverRules { LosesMomentum = true } };
        Assert.Equal("momentum", Assert.Single(Run(options with { PrepareOnTime = on => on.WithParts(parts) }).Failures).Promise);
    }

    /// <summary>A promise that is not told what players do takes that for what the world does, and is seen to be broken.</summary>
    [Theory]
    [InlineData("speed")]
    [InlineData("energy")]
    [InlineData("momentum")]
    [InlineData("depth")]
    public void Run_PromiseThatKnowsNothingOfActs_IsSeenToBeBroken(string name)
    {
        WorldReport report = Run(new WorldOptions
        {
            Worlds = 56,
            Seed = 1400,
            ShrinkingPlays = 0,
            Promises = world => [.. WorldPromise.All(world).Where(p => p.Name == name).Select(p => new Unaware(p))],
        });
        Assert.Equal(0, report.CountOf(WorldFailureKind.Ended));
        Assert.Contains(report.Failures, f => f.Promise == name && f.Failure!.Contains($"{name} at ", StringComparison.Ordinal));
    }

    /// <summary>Promises about single states, of worlds whose states are wrong on purpose.</summary>
    [Theory]
    [InlineData(0.9, false)]
    [InlineData(0.8, true)]
    public void Finish_ReboundWithAnotherRestitution_IsSeen(double expected, bool isSeen)
    {
        Scene scene = new SceneBuilder("bounce").AddPlane("floor", Vector3D.Up, Vector3D.Zero)
            .AddBody("ball", new BodySpec(0.1, 1, 0.9), new Vector3D(0, 1, 0)).Build();
        Simulation world = new(scene, new SimulationOptions(history: SimDuration.MaxValue));
        world.AdvanceTo(SimTime.FromSeconds(1));
        ReboundPromise promise = new(spec => spec.Restitution * expected / 0.9);
        promise.Finish(new WorldMoment(world, []), []);
        Assert.Equal(isSeen, promise.Broken is not null);
    }

    [Fact]
    public void Run_WorldThatEnds_IsCountedApartAndNamesWhy()
    {
        WorldReport report = Run(new WorldOptions { Worlds = 2, ShrinkingPlays = 0, Promises = static _ => [new Ending()] });
        Assert.Equal(2, report.CountOf(WorldFailureKind.Ended));
        Assert.All(report.Failures, f => Assert.EndsWith("ended by SimulationException: on purpose", f.Failure, StringComparison.Ordinal));
        Assert.Equal("lagsim check --worlds 1 --seed 2", report.Failures[1].Command);
    }

    [Fact]
    public void Run_OneAtATimeOrTwo_IsTheSame()
    {
        WorldOptions options = new() { Worlds = 14, Seed = 1414 };
        string[] once = Texts(Run(options with { Workers = 1 }));
        Assert.Equal(once, Texts(Run(options with { Workers = 2 })));
        Assert.Equal(14, once.Distinct().Count());
    }

    [Fact]
    public void Run_AskedToStop_ReportsWhatIsDone()
    {
        using CancellationTokenSource stop = new();
        WorldReport report = WorldCheck.Run(
            new WorldOptions { Worlds = 1_000_000, ShrinkingPlays = 0, Promises = _ => [new Stopping(stop)] }, null, stop.Token);
        Assert.True(report.IsStopped);
        Assert.Equal(1_000_000, report.AskedFor);
    }

    private static string[] Texts(WorldReport report) =>
        [.. report.Outcomes.Select(o => $"{o.Seed} {o.Kind} {o.Acts} {o.ActsAtEvents} {o.Meetings} {o.Events} {o.Compared} {o.Failure}")];

    private static WorldReport Run(WorldOptions options) => WorldCheck.Run(options, null, TestContext.Current.CancellationToken);

    private sealed class Ending : WorldPromise
    {
        internal override string Name => "ending";

        internal override void Look(WorldMoment moment) => throw new SimulationException("on purpose");
    }

    private sealed class Unaware(WorldPromise promise) : WorldPromise
    {
        internal override string Name => promise.Name;

        internal override void Look(WorldMoment moment)
        {
            promise.Look(new WorldMoment(moment.Simulation, []));
            if (promise.Broken is not null)
            {
                Break(moment, promise.Broken);
            }
        }
    }

    private sealed class Stopping(CancellationTokenSource stop) : WorldPromise
    {
        internal override string Name => "stopping";

        internal override void Look(WorldMoment moment) => stop.Cancel();
    }
}
