using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Harness.Experiments.Compare;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Harness.Experiments.Peers;
using LagSim.Harness.SceneFiles;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Compare;

/// <summary>Every strategy on a link, in virtual time, and what is measured of it.</summary>
public sealed class CompareTestTests
{
    private static readonly Dictionary<string, CompareRun> Known = [];

    public static TheoryData<string> Promising => new(LateEventStrategies.Names.Where(name => LateEventStrategies.Create(name).PromisesAgreement));

    public static TheoryData<string, string> Links => new(
        LinkProfiles.All.SelectMany(link => new[] { "pair", "drop" }.Select(scene => new TheoryDataRow<string, string>(scene, link.Name))));

    [Theory]
    [MemberData(nameof(Promising))]
    public void Run_OfAStrategyThatPromisesAgreement_SettlesOnTheWorldThatHadAllOnTime(string strategy)
    {
        CompareRun run = Billiards(strategy);
        Assert.True(run.Agrees);
        Assert.All(run.StateHashes, hash => Assert.Equal(run.TruthStateHash, hash));
        Assert.Equal(0, run.Seen.Before.ToStatistics().DifferingBits);
        Assert.Equal(0, run.Seen.After.ToStatistics().DifferingBits); // as seen too: not a sample longer than the event was on its way
        Assert.True(run.Heals > 0);
        Assert.False((run with { TruthEventHash = run.TruthEventHash ^ 1 }).Agrees);
    }

    [Theory]
    [InlineData("none")]
    [InlineData("latency-forward")]
    public void Run_OfAStrategyThatPromisesNothing_IsWorseAfterTheEvents(string strategy)
    {
        CompareRun run = Billiards(strategy);
        Assert.False(run.Agrees);
        Assert.True(run.Seen.After.ToStatistics().MaxMetres > 0.5);
        Assert.True(run.SeenFromTruth.After.ToStatistics().MaxMetres > 0.5);
        Assert.Equal(0, run.Heals);
    }

    [Theory]
    [MemberData(nameof(Links))]
    public void Run_HealingOnEveryLink_IsWrongFromTheStampUntilTheEventComesAndNotASampleLonger(string scene, string link)
    {
        CompareRun run = Run(scene, link, "healing");
        Assert.True(run.Agrees);
        Assert.Equal(0, Outside(run));
        ErrorStatistics after = run.Seen.After.ToStatistics(), truth = run.SeenFromTruth.After.ToStatistics();
        Assert.Equal((0, 0, 0), (after.DifferingBits, after.StalledSamples, truth.DifferingBits));
        Assert.True(after.Samples > 300);
        Assert.Equal(12, run.Trace.Events.Count(e => e.Dealt is not null));
        Assert.True(Outside(Run(scene, link, "none")) > 0); // the control
    }

    [Fact]
    public void Divergence_OfAnEvent_LastsUntilTheRenderSnapshotAfterTheArrival()
    {
        // Two hops of 100 ms to the players, one to or from the host; and the error is there to the last sample before.
        CompareRun run = Run("pair", "delay-100ms", "healing");
        Assert.All(run.Trace.Events, e => Assert.InRange((double)e.Dealt! - e.Stamp, 0.0999, 0.202));
        Assert.Equal(run.Lateness.Max, run.Divergence.Max, 0.01);
        int lasting = run.Trace.Events.Count(e => Error(run, (double)e.Dealt! - 0.005) > 0 && Error(run, (double)e.Dealt!) == 0);
        Assert.True(lasting >= 6, $"{lasting}"); // others' windows overlap
        CompareRun none = Run("pair", "delay-100ms", "none");
        Assert.DoesNotContain(none.Trace.Events, e => Error(none, (double)e.Dealt!) == 0); // the control
    }

    [Fact]
    public void EventsRerun_OfAFullRollback_AreMoreThanOfTheCone()
    {
        CompareRun cone = Billiards("healing"), full = Billiards("full-rollback");

        // Each has the state of its truth, to the bit. The truths may differ, for a stamp is a peer's clock, which may be off by some ticks.
        Assert.True(cone.Agrees && full.Agrees);
        Assert.All(cone.Trace.Events.Zip(full.Trace.Events), pair => Assert.Equal(pair.First.Stamp, pair.Second.Stamp, 1e-9));
        Assert.True(full.EventsRerun.Mean > 2 * cone.EventsRerun.Mean, $"{full.EventsRerun} {cone.EventsRerun}");
        Assert.True(full.ConeBodies.Mean >= 16 && cone.ConeBodies.Mean is >= 1 and < 4, $"{full.ConeBodies} {cone.ConeBodies}");
        Assert.True(cone.EventsRerun.P99 >= cone.EventsRerun.Mean);
    }

    [Fact]
    public void TimeToHeal_OfARun_IsThereForEveryKindOfStrategy() =>
        Assert.All(LateEventStrategies.Names, name => Assert.True(Billiards(name).TimeToHeal is { P50: > 0 } time && time.Max >= time.P99));

    [Theory]
    [InlineData("interpolation", 0.1, false)] // two hops of 40 ms: all events have come before it is drawn
    [InlineData("interpolation", 0.05, true)]
    [InlineData("interpolation", 0, true)]
    [InlineData("healing", 0.1, true)]
    public void Corrections_LateEventsWithinTheDelay_AreNone(string strategy, double delay, bool jumps)
    {
        CompareRun run = Run("pair", "delay-40ms", strategy, delay);
        Assert.Equal(jumps, run.CorrectionsSeen > 0);
        Assert.Equal(jumps, run.Corrections.Max > 0.01);
        Assert.Equal(jumps, run.Seen.During.ToStatistics().MaxMetres > 0.01);
        Assert.Equal(0, run.Seen.After.ToStatistics().DifferingBits);
    }

    [Theory]
    [InlineData("healing", 0.1, 0)]
    [InlineData("full-rollback", 0.1, 0)]
    [InlineData("none", 0.1, 0)]
    [InlineData("interpolation", 0.1, 100)]
    [InlineData("interpolation", 0.3, 300)]
    public void InputLatency_OfAStrategy_IsItsDelayAndUpToASample(string strategy, double delay, double milliseconds)
    {
        CompareRun run = Run("pair", "lan", strategy, delay);
        Assert.InRange(run.InputLatency.P50, milliseconds, milliseconds + 5.01);
        Assert.InRange(run.InputLatency.Max, milliseconds, milliseconds + 5.01);
    }

    [Fact]
    public void FromTruth_OfInterpolation_IsTheDelayTimesTheSpeed()
    {
        // It agrees with itself and lags behind the world: that is what it looks like to compare the two.
        CompareRun run = Run("pair", "lan", "interpolation");
        Assert.Equal(0, run.Seen.After.ToStatistics().MaxMetres);
        Assert.InRange(run.SeenFromTruth.After.ToStatistics().MaxMetres, 0.3, 3);
        Assert.Equal(0, Run("pair", "lan", "interpolation", 0).SeenFromTruth.After.ToStatistics().MaxMetres);
    }

    [Fact]
    public void Run_Twice_IsTheSameButForTheTimeItTook()
    {
        CompareRun first = Fresh("billiards", "awful", "healing", 0.1, 3), again = Fresh("billiards", "awful", "healing", 0.1, 3);
        Assert.Equal(Text(first), Text(again));
        Assert.NotEqual(Text(first), Text(Fresh("billiards", "awful", "healing", 0.1, 4)));

        static string Text(CompareRun run) => string.Join(
            " ", All(run.Seen), All(run.SeenTrueTime), All(run.SeenFromTruth), All(run.Settled), run.EventsRerun, run.ConeBodies, run.Corrections, run.CorrectionsSeen, run.InputLatency,
            run.Divergence, run.Lateness, run.Events, run.Heals, string.Join(' ', run.BytesSentPerSecond), string.Join(' ', run.EventHashes), run.ClockErrorMilliseconds);

        static string All(PhaseErrors errors) => $"{errors.Before.ToStatistics()} {errors.During.ToStatistics()} {errors.After.ToStatistics()}";
    }

    [Fact]
    public void Run_OfSpawnedBodies_ComparesThemToo()
    {
        Scene scene = BuiltInScenes.Pair();
        PlannedAction spawn = new(
            SimDuration.FromSeconds(1), 1, EventKind.Spawn, new BodyId(1, 1, 0), new Vector3D(0, 9, 5), new Vector3D(1, 0, 0), scene.Bodies[0].Spec);
        CompareRun none = CompareTest.Run(new CompareOptions(scene, [spawn], "none", LinkProfiles.PureDelay(100)));
        CompareRun healing = CompareTest.Run(new CompareOptions(scene, [spawn], "healing", LinkProfiles.PureDelay(100)));
        Assert.InRange(none.Seen.After.ToStatistics().MaxMetres, 0.1, 3); // it falls, 0.1 s late
        Assert.Equal(0, healing.Seen.After.ToStatistics().DifferingBits);
        ErrorStatistics during = healing.Seen.During.ToStatistics();
        Assert.Equal(0, during.MaxMetres); // who does not have it is no distance away
        Assert.InRange(during.DifferingBits, 40, 41); // two hops of 100 ms
    }

    [Fact]
    public void Run_OfMoreBodiesThanAreWatched_IsRefusedWithBothNumbers()
    {
        SceneException refused = Assert.Throws<SceneException>(() => CompareTest.Run(new CompareOptions(BuiltInScenes.Crowd(501), [], "healing", LinkProfiles.Lan)));
        Assert.Contains("501 bodies", refused.Message, StringComparison.Ordinal);
        Assert.Contains("at most 500", refused.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void PhaseAt_OfSeveralEvents_IsDuringWhileAnyIsOnItsWay()
    {
        (SimTime, SimTime)[] windows = [(TestWorlds.At(1), TestWorlds.At(2)), (TestWorlds.At(1.5), TestWorlds.At(3)), (TestWorlds.At(4), SimTime.MaxValue)];
        Phase[] phases = new[] { 0.5, 1, 1.9, 2.9, 3, 3.9, 4, 9 }.Select(time => LateEventWatch.PhaseAt(windows, TestWorlds.At(time))).ToArray();
        Assert.Equal([Phase.Before, Phase.During, Phase.During, Phase.During, Phase.After, Phase.After, Phase.During, Phase.During], phases);
    }

    private static CompareRun Billiards(string strategy) => Run("billiards", "delay-100ms", strategy);

    /// <summary>A run that several tests look at is made once.</summary>
    private static CompareRun Run(string scene, string link, string strategy, double delay = 0.1)
    {
        string key = FormattableString.Invariant($"{scene} {link} {strategy} {delay}");
        lock (Known)
        {
            return Known.TryGetValue(key, out CompareRun? run) ? run : Known[key] = Fresh(scene, link, strategy, delay, 1);
        }
    }

    private static CompareRun Fresh(string scene, string link, string strategy, double delay, ulong seed)
    {
        BuiltInScenes.TryGet(scene, out Scene? known);
        LinkProfiles.TryGet(link, out LinkProfile? profile, out _);
        return CompareTest.Run(new CompareOptions(known!, PlayerPlan.Draw(known!, 4, seed), strategy, profile!) { Seed = seed, DisplayDelay = SimDuration.FromSeconds(delay) });
    }

    /// <summary>The largest error as seen outside of all windows from a stamp to when the last peer showed it.</summary>
    private static double Outside(CompareRun run) => run.Trace.Seconds
        .Select((time, n) => (Time: time, Error: run.Trace.SeenError[n]))
        .Where(sample => !run.Trace.Events.Any(e => sample.Time >= e.Stamp && !(sample.Time >= e.Dealt)))
        .Max(sample => sample.Error);

    /// <summary>The error of the first sample from a time on.</summary>
    private static double Error(CompareRun run, double time) => run.Trace.SeenError[Array.FindIndex(run.Trace.Seconds, seconds => seconds >= time)];
}
