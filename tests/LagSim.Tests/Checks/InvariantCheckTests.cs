using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Check;
using LagSim.Harness.Links;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Checks;

/// <summary>Random sessions against the one invariant, and that the check catches what breaks it.</summary>
public sealed class InvariantCheckTests
{
    [Fact]
    public void Run_RandomSessions_NoBitDiffersAndNothingIsLost()
    {
        CheckOptions options = new() { Sessions = 150, Seed = 1_000_001 };
        CheckReport report = Run(options);

        Assert.True(report.Failures.Count == 0, string.Join(Environment.NewLine, report.Failures.Select(f => $"{f.Whole.Failure} {f.Least.Difference} {f.Command}")));
        Assert.Equal((150, 0L, 0L), (report.Outcomes.Count, report.DifferingBits, report.LostEvents));
        Assert.All(report.Outcomes, o => Assert.True(o.TooLateEvents == 0 || o.HasFullLinks || o.HasStops, $"seed {o.Seed}: {o.TooLateEvents} too late"));

        // Else little was shown.
        Assert.True(report.HealsThatChangedAnImpact >= 0.3 * report.Heals && report.Heals > 5_000, $"{report.HealsThatChangedAnImpact} of {report.Heals}");
        Assert.All(report.Outcomes, o => Assert.True(o.ExternalEvents >= 20, $"seed {o.Seed}: {o.ExternalEvents} events"));
        Assert.All(report.Outcomes, o => Assert.True(o.Compared > 100, $"seed {o.Seed}: {o.Compared} compared"));
        Assert.True(report.Outcomes.Sum(o => o.LateJoiners) > 50 && report.Outcomes.Sum(o => o.Leavers) > 20);
        Assert.True(report.Outcomes.Sum(o => o.TiedEvents) > 500);
        Assert.True(report.Outcomes.Count(o => o.HasFullLinks) > 40 && report.Outcomes.Count(o => o.HasStops) > 10);
        Assert.Superset(Enumerable.Range(2, 7).ToHashSet(), report.Outcomes.Select(o => o.Peers).ToHashSet());

        // What is rare is met all the same.
        int[] met = [.. SceneFeatures.All.Select(feature => report.SessionsThatMet(feature.IsMet))];
        Assert.Equal(13, met.Length);
        Assert.True(met.Zip([5, 4, 2, 10, 5, 2, 3, 4, 4, 10, 4, 4, 6]).All(pair => pair.First >= pair.Second), string.Join(' ', met));
    }

    [Fact]
    public void Draw_ManySeeds_EverySortOfSceneLinkAndDeed()
    {
        CheckCase[] cases = [.. Enumerable.Range(1, 60).Select(seed => new CheckCase((ulong)seed, new CheckOptions()))];
        Assert.All(cases, c => Assert.InRange(c.Scene.Bodies.Count, 8, 12));
        Assert.All(cases, c => Assert.True(c.Deeds.Count >= 20 && c.Deeds.Zip(c.Deeds.Skip(1)).All(pair => pair.First.AtSeconds <= pair.Second.AtSeconds)));
        Assert.Equal(2, cases.Select(c => c.Scene.Gravity == Vector3D.Zero).Distinct().Count());
        Assert.Contains(cases, c => c.Scene.StaticSpheres.Count > 0);
        MotionLaw[] flights = [.. cases.SelectMany(c => c.Scene.Bodies).Select(b => b.Spec.Flight).Distinct()];
        Assert.Superset(new HashSet<MotionLaw> { MotionLaw.Ballistic, MotionLaw.RungeKutta4, MotionLaw.ClosedForm, MotionLaw.DormandPrince54 }, flights.ToHashSet());
        Assert.Contains(cases, c => c.Scene.Bodies.Any(b => b.Spec.Friction > 0 && b.Spin != Vector3D.Zero));
        Assert.All(Enumerable.Range(0, 7), n => Assert.Contains(cases, c => c.Scene.Forces.Count == 7 && c.Scene.Bodies.Any(b => b.Spec.Forces.Contains(n))));
        Assert.Contains(cases, c => c.Scene.Bodies.Any(b => b.Spec.Restitution == 0));
        Assert.Equal(8, cases.SelectMany(c => c.Deeds).Select(d => d.Kind).Distinct().Count());
        Assert.Contains(cases.SelectMany(c => c.Deeds), d => d.Kind == EventKind.Spawn && d.Spin != Vector3D.Zero && d.Spec.Friction > 0);
        HashSet<string> links = [.. cases.SelectMany(c => c.Players.Skip(1)).Select(p => p.Link.Name)];
        Assert.Superset(LinkProfiles.All.Where(p => !p.Name.StartsWith("delay-", StringComparison.Ordinal)).Select(p => p.Name).ToHashSet(), links);
        Assert.Contains(cases.SelectMany(c => c.Players), p => p.Link.RoundTripMilliseconds > 3_000);
        Assert.Contains(cases.SelectMany(c => c.Players), p => p.IsKilled && p.LeavesAtSeconds is not null);
        Assert.All(cases, c => Assert.True(c.History <= SimDuration.FromSeconds(5)));
    }

    [Fact]
    public void Draw_ManySeeds_WhatIsRareToo()
    {
        CheckCase[] cases = [.. Enumerable.Range(1, 150).Select(seed => new CheckCase((ulong)seed, new CheckOptions()))];
        Assert.Contains(cases, c => c.Scene.Bodies.Max(b => b.Spec.Mass) >= 1e6 * c.Scene.Bodies.Min(b => b.Spec.Mass));
        CheckCase[] boxes = [.. cases.Where(c => c.Scene.Box.Exists)];
        Assert.InRange(boxes.Length, 2, 15);
        Assert.Contains(boxes, c => c.Deeds.Any(d => d.Kind == EventKind.Spawn));
        CheckCase[] orbits = [.. cases.Where(c => c.Scene.Forces.Any(f => f.Kind == ForceKind.Central && f.Power == -2))];
        Assert.InRange(orbits.Length, 3, 20);
        Assert.All(orbits, c => Assert.Contains(c.Scene.Bodies, b => b.Spec.Flight == MotionLaw.ClosedForm)); // of Kepler's problem: no gravity, one pull
        Assert.Contains(orbits, c => c.Scene.Bodies.Any(b => b.Spec.Flight == MotionLaw.DormandPrince54));
        Assert.Contains(orbits, c => c.Scene.Bodies.Any(b => b.Spec.RollingResistance > 0) && c.Scene.StaticSpheres.Count > 0);
        CheckCase[] heaps = [.. cases.Where(c => c.Scene.Planes.Count == 1)];
        Assert.InRange(heaps.Length, 4, 20);
        CheckCase[] pits = [.. Enumerable.Range(1, 40).Select(seed => new CheckCase((ulong)seed, new CheckOptions { Pits = true }))
            .Where(c => c.Scene.ContactTolerance is 1e-2 or 1e-4)];
        Assert.InRange(pits.Length, 3, 12);
        Assert.All(heaps.Concat(pits), c => Assert.Contains(c.Deeds, d => d.Kind == EventKind.Grab));
        Assert.Contains(heaps, c => c.Scene.StaticSpheres.Count > 0);

        // Under gravity, among walls.
        SceneBody[] falling = [.. cases.Where(c => c.Scene.Planes.Count == 6 && c.Scene.Gravity != Vector3D.Zero).SelectMany(c => c.Scene.Bodies)];
        Assert.All(Enumerable.Range(1, 6), n => Assert.Contains(falling, b => b.Spec.Forces.Contains(n)));
        Assert.Contains(falling, b => !b.Spec.Forces.IsEmpty && b.Spec.RollingResistance > 0);
        Assert.Contains(cases.SelectMany(c => c.Scene.Bodies), b => b.Spec.Flight == MotionLaw.DormandPrince54 && b.Spec.Tolerance == 0);
        Assert.All([ForceKind.LinearDrag, ForceKind.QuadraticDrag], kind => Assert.Equal(
            2, cases.SelectMany(c => c.Scene.Forces).Where(f => f.Kind == kind).Select(f => f.Vector == Vector3D.Zero).Distinct().Count()));
    }

    /// <summary>Sessions of which a third are heaps, as the tool draws them.</summary>
    [Fact]
    public void Run_SessionsWithHeapsInPits_NoBitDiffers()
    {
        CheckReport report = Run(new CheckOptions { Sessions = 30, Seed = 1_000_120, Pits = true });
        Assert.True(report.Failures.Count == 0, string.Join(Environment.NewLine, report.Failures.Select(f => $"{f.Whole.Failure} {f.Command}")));
        Assert.InRange(report.SessionsThatMet(met => met.LargeIsland), 3, 20);
    }

    [Fact]
    public void Run_OneAtATimeOrTwo_IsTheSame()
    {
        CheckOptions options = new() { Sessions = 6, Seed = 40 };
        string[] once = Texts(Run(options with { Workers = 1 }));
        Assert.Equal(once, Texts(Run(options with { Workers = 2 })));
        Assert.Equal(6, once.Distinct().Count());
    }

    [Fact]
    public void Run_CutsByTime_IsCaughtAndShrunkToTwoDeedsOfOneTick()
    {
        CheckOptions options = new() { Sessions = 4, Seed = 2, Strategy = "full-rollback", Prepare = static (_, simulation) => simulation.CutsByTime = true };
        CheckReport report = Run(options);
        CheckFailure failure = report.Failures[0];
        Assert.Equal(2UL, failure.Whole.Seed);
        Assert.True(failure.Least.Deeds.Count == 2 && failure.Least.Bodies.Count <= 2, failure.Command);
        Assert.StartsWith("lagsim check --seed 2 --sessions 1 --strategy full-rollback --bodies ", failure.Command, StringComparison.Ordinal);
        AssertLeast(failure.Least, options);
        CheckCase least = new(2, options with { Bodies = failure.Least.Bodies, Events = failure.Least.Deeds });
        Assert.Single(least.DeedIndices.Select(i => least.Deeds[i].AtSeconds).Distinct());

        // What it names plays again to the same; without the fault it does not fail.
        CheckOptions again = options with { Sessions = 1, Seed = 2, Bodies = failure.Least.Bodies, Events = failure.Least.Deeds, ShrinkingPlays = 0 };
        Assert.Equal(failure.Least.Difference, Run(again).Failures.Single().Whole.Difference);
        Assert.Empty(Run(again with { Prepare = null }).Failures);
    }

    private static void AssertLeast(CheckOutcome least, CheckOptions options)
    {
        foreach (int deed in least.Deeds)
        {
            Assert.Null(Failure(least.Bodies, [.. least.Deeds.Where(d => d != deed)]));
        }

        foreach (int body in least.Bodies)
        {
            Assert.True(least.Bodies.Count == 1 || Failure([.. least.Bodies.Where(b => b != body)], least.Deeds) is null);
        }

        string? Failure(IReadOnlyList<int> bodies, IReadOnlyList<int> deeds) =>
            CheckSession.Play(least.Seed, options with { Bodies = bodies, Events = deeds }, TestContext.Current.CancellationToken).Failure;
    }

    [Fact]
    public void Run_OperandsSwappedOnOnePeer_IsCaughtThere()
    {
        CheckOptions options = new() { Sessions = 4, ShrinkingPlays = 0, Prepare = static (peer, simulation) => simulation.SwapsOperands = peer == 1 };
        CheckReport report = Run(options);
        Assert.NotEmpty(report.Failures);
        Assert.All(report.Failures, f => Assert.True(f.Whole.Difference is null || f.Whole.Difference.Peer == 1));
        FirstDifference first = report.Failures.Select(f => f.Whole.Difference).First(d => d is not null)!;
        Assert.Equal(EventKind.Impact, first.ExpectedKey!.Value.Kind);
        Assert.NotEqual((first.ExpectedKey, first.Expected.Position), (first.ActualKey, first.Actual.Position));
    }

    [Theory]
    [InlineData(HealingFault.ForgetsThePast, 1u)]
    [InlineData(HealingFault.OverlooksWhoIsAhead, 1u)]
    [InlineData(HealingFault.GivesUpByBody, 15u, true)]
    [InlineData(HealingFault.DropsEvents, 1u)]
    [InlineData(HealingFault.LeavesMates, 29u)]
    [InlineData(HealingFault.CutsByTime, 1u)]
    [InlineData(HealingFault.LeavesWhoRests, 29u)]
    [InlineData(HealingFault.CutsMembersAlone, 4u, true)]
    [InlineData(HealingFault.ForgetsWhoWasLookedAt, 4u, true)]
    internal void Run_HealingInAWayKnownToBeWrong_IsCaughtByItsSeed(HealingFault fault, uint seed, bool pits = false)
    {
        // The seeds that docs/HEALING.md names.
        CheckOptions options = new() { Sessions = 1, Seed = seed, Pits = pits, ShrinkingPlays = 0, Prepare = (_, simulation) => simulation.Fault = fault };
        CheckOutcome failed = Assert.Single(Run(options).Failures).Whole;
        Assert.True(failed.DifferingBits > 0 && failed.Difference is not null, failed.Failure);

        // It is the fault that it caught: without it the same session is as it should be.
        Assert.Empty(Run(options with { Prepare = null }).Failures);
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Run_PeriodicBoxOrOrbits_PassesAndCatchesAFault(bool isBox)
    {
        ulong seed = Enumerable.Range(1, 150).Select(n => (ulong)n).First(n => Is(new CheckCase(n, new CheckOptions()).Scene));
        CheckOptions options = new() { Sessions = 1, Seed = seed, ShrinkingPlays = 0 };
        CheckReport right = Run(options);
        Assert.Empty(right.Failures);
        Assert.Equal((isBox ? 1 : 0, isBox ? 0 : 1), (right.SessionsThatMet(m => m.PeriodicBox), right.SessionsThatMet(m => m.ClosedOrbit)));
        CheckReport wrong = Run(options with { Prepare = static (_, simulation) => simulation.Fault = HealingFault.ForgetsThePast });
        Assert.True(Assert.Single(wrong.Failures).Whole.DifferingBits > 0);

        bool Is(Scene scene) => isBox ? scene.Box.Exists : scene.Forces.Any(f => f.Kind == ForceKind.Central && f.Power == -2);
    }

    [Fact]
    public void Draw_Hands_TakeMoveAndLetGoAndAreAfterTheSameBody()
    {
        CheckCase[] cases = [.. Enumerable.Range(1, 60).Select(seed => new CheckCase((ulong)seed, new CheckOptions()))];
        CheckDeed[][] hands = [.. cases.Select(c => c.Deeds.Where(d => d.Kind is EventKind.Grab or EventKind.HoldKnot or EventKind.Release).ToArray())];
        Assert.True(hands.Count(h => h.Length > 0) > 30);
        Assert.Contains(hands, h => h.Where(d => d.Kind == EventKind.Grab).GroupBy(d => (d.Body, d.Spawn)).Any(g => g.Select(d => d.Peer).Distinct().Skip(1).Any()));
        Assert.All(cases, c => Assert.All(c.Deeds, d => Assert.True(d.Spawn < 0 || (c.Deeds[d.Spawn].Kind == EventKind.Spawn && c.Deeds[d.Spawn].AtSeconds <= d.AtSeconds))));
    }

    [Theory]
    [InlineData("none")]
    [InlineData("latency-forward")]
    public void Run_StrategyThatDoesNotAgree_FailsEverywhere(string strategy)
    {
        CheckReport report = Run(new CheckOptions { Sessions = 4, Strategy = strategy, ShrinkingPlays = 0 });
        Assert.Equal([1UL, 2, 3, 4], report.Failures.Select(f => f.Whole.Seed));
        Assert.True(report.DifferingBits > 1_000);
    }

    [Fact]
    public void Run_HistoryTooShort_TooLateIsAFailure()
    {
        // Half a second there, and a quarter of one is allowed: the host refuses what joiners do, and their senders take it back.
        CheckOptions options = new() { Sessions = 3, Profile = LinkProfiles.PureDelay(500), ShrinkingPlays = 0, History = SimDuration.FromMilliseconds(250) };
        CheckReport report = Run(options);
        Assert.Equal([1UL, 2, 3], report.Failures.Select(f => f.Whole.Seed));
        Assert.All(report.Outcomes, o => Assert.Equal((true, $"{o.TooLateEvents} events were too late."), (o.TooLateEvents > 0, o.Failure)));
        Assert.Equal(0, report.DifferingBits);

        // The control: with the history that such a link needs none of them is.
        CheckReport whole = Run(options with { History = null });
        Assert.Equal((0, 0L, 0L), (whole.Failures.Count, whole.TooLateEvents, whole.DifferingBits));
    }

    [Fact]
    public void Run_AskedToStop_ReportsWhatIsDone()
    {
        using CancellationTokenSource stop = new();
        CheckOptions options = new() { Sessions = 100_000, Seed = 40, Workers = 2 };
        CheckReport report = InvariantCheck.Run(options, done => StopAfter(3, done), stop.Token);
        Assert.InRange(report.Outcomes.Count, 3, 99_999);
        Assert.True(report.IsStopped);
        Assert.Equal(100_000, report.AskedFor);
        Assert.Empty(report.Failures);
        Assert.All(report.Outcomes, o => Assert.True(o.ExternalEvents > 0 && o.Compared > 0, $"seed {o.Seed}"));

        // What is reported is whole: those sessions come to the same where nobody stops them.
        CheckOutcome[] first = [.. report.Outcomes.Take(3)]; // one that takes long may be missing between them
        CheckReport whole = Run(options with { Sessions = (int)(first[^1].Seed - options.Seed) + 1 });
        Assert.False(whole.IsStopped);
        Assert.Equal(Texts(whole with { Outcomes = [.. whole.Outcomes.Where(o => first.Any(f => f.Seed == o.Seed))] }), Texts(report with { Outcomes = first }));

        void StopAfter(int sessions, int done)
        {
            if (done >= sessions)
            {
                stop.Cancel();
            }
        }
    }

    [Fact]
    public void Play_AskedToStopInTheMiddle_HasNoOutcome()
    {
        using CancellationTokenSource stop = new();
        int begun = 0;
        CheckOptions options = new() { FromPeers = 3, ToPeers = 3, Prepare = (_, _) => begun += StopAtTheSecond() };
        Assert.Throws<OperationCanceledException>(() => CheckSession.Play(40, options, stop.Token));
        Assert.Equal(2, begun); // worlds; the third never began
        Assert.Throws<OperationCanceledException>(() => CheckSession.Play(40, options, stop.Token));

        int StopAtTheSecond()
        {
            if (begun == 1)
            {
                stop.Cancel();
            }

            return 1;
        }
    }

    [Fact]
    public void Run_AskedToStopWhileAPeersWorldComesToNoEnd_EndsAndNamesTheSeed()
    {
        const ulong Endless = 40;
        Assert.Null(CheckSession.Play(Endless, new CheckOptions(), TestContext.Current.CancellationToken).Failure); // by itself it ends
        CheckCase drawn = new(Endless, new CheckOptions());
        using CancellationTokenSource stop = new();
        CheckOptions options = new() { Sessions = 100, Seed = Endless - 1, Workers = 1, Prepare = (peer, simulation) => Disturb(peer, simulation) };
        CheckReport report = InvariantCheck.Run(options, null, stop.Token);
        Assert.Equal([Endless], report.StoppedSeeds);
        Assert.Equal([Endless - 1], report.Outcomes.Select(o => o.Seed));
        Assert.True(report.IsStopped);

        // The control: that world would have gone on for hours.
        long events = 100_000;
        Simulation alone = new(drawn.Scene, new SimulationOptions());
        Submit(alone);
        Assert.False(alone.TryAdvanceTo(At(CheckCase.Length), ref events) || alone.SimulatedTo > At(0.01), alone.SimulatedTo.ToShortString());

        void Disturb(int peer, Simulation simulation)
        {
            if (peer == 1 && simulation.Scene.Hash == drawn.Scene.Hash)
            {
                Submit(simulation);
                new Thread(() => StopAfter(simulation)) { IsBackground = true }.Start();
            }
        }

        void StopAfter(Simulation simulation)
        {
            while (simulation.EventsProcessed < 20_000)
            {
                Thread.Yield(); // another thread counts
            }

            stop.Cancel();
        }

        // Between floor and ceiling, which take no speed from it, and it is too heavy to be put off by whom it meets.
        static void Submit(Simulation simulation) => simulation.Submit(
            ExternalEvent.Spawn(simulation.Start + SimDuration.FromMilliseconds(1), 200, 1, new BodySpec(0.15, 1e9, 1), V(0.95, 0.4, 0.9), V(0, 1e8)));
    }

    [Fact]
    public void Run_OptionsOutOfRange_AreRefusedByName()
    {
        Assert.Contains("0 to", Assert.Throws<ArgumentException>(() => Run(new CheckOptions { Sessions = 1, Bodies = [0, 99] })).Message, StringComparison.Ordinal);
        Assert.Contains("2 to 8", Assert.Throws<ArgumentOutOfRangeException>(() => Run(new CheckOptions { FromPeers = 5, ToPeers = 4 })).Message, StringComparison.Ordinal);
        Assert.Contains("one session", Assert.Throws<ArgumentException>(() => Run(new CheckOptions { Events = [1] })).Message, StringComparison.Ordinal);
    }

    private static string[] Texts(CheckReport report) => [.. report.Outcomes.Select(
        o => $"{o.Seed} {o.Peers} {o.Events} {o.ExternalEvents} {o.LateEvents} {o.Heals} {o.HealsThatChangedAnImpact} {o.Impacts} {o.Compared} {o.Failure}")];

    private static CheckReport Run(CheckOptions options) => InvariantCheck.Run(options, null, TestContext.Current.CancellationToken);

    [Theory]
    [InlineData(0.4, true)] // it is not where the other one comes to: the impact at 0.5 s is gone
    [InlineData(0.6, false)] // the impact was before
    public void HealImpacts_OneLateEvent_CountsWhetherAnImpactIsGone(double stamp, bool changes)
    {
        Scene scene = new SceneBuilder("two").WithGravity(Floating)
            .AddBody("left", Ball(0.5), V(-1)).AddBody("right", Ball(0.5), V(1), V(-2)).Build();
        Simulation simulation = new(scene, KeepAll);
        HealImpacts heals = new(simulation, _ => true);
        simulation.AdvanceTo(At(1));
        Assert.Equal(0, heals.Heals);
        simulation.Submit(ExternalEvent.Teleport(At(stamp), 1, 1, First, V(-1, 5)));
        Assert.Equal((1L, changes ? 1L : 0L), (heals.Heals, heals.Changed));

        // The same impact made again is no change: the body that was to be hit only turns out to have had its velocity set to what it was.
        simulation.Submit(ExternalEvent.SetVelocity(At(0.2), 1, 2, Second, V(-2)));
        Assert.Equal((2L, changes ? 1L : 0L), (heals.Heals, heals.Changed));
    }
}
