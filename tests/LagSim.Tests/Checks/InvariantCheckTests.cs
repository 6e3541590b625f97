using System;
using System.Linq;
using System.Threading;
using LagSim.Events;
using LagSim.Harness.Verification.Check;
using LagSim.Scenes;
using LagSim.Testing.Links;
using LagSim.Time;
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
        Assert.True(report.Outcomes.Sum(o => o.LateClients) > 50 && report.Outcomes.Sum(o => o.Leavers) > 20);
        Assert.True(report.Outcomes.Sum(o => o.TiedEvents) > 500);
        Assert.True(report.Outcomes.Count(o => o.HasFullLinks) > 40 && report.Outcomes.Count(o => o.HasStops) > 10);
        Assert.Superset(Enumerable.Range(2, 7).ToHashSet(), report.Outcomes.Select(o => o.Peers).ToHashSet());

        // What is rare is met all the same.
        int[] met = [.. SceneFeatures.All.Select(feature => report.SessionsThatMet(feature.IsMet))];
        Assert.Equal(18, met.Length);
        Assert.True(met.Zip([5, 4, 2, 10, 5, 2, 3, 4, 4, 10, 4, 4, 6, 5, 5, 5, 3, 3]).All(pair => pair.First >= pair.Second), string.Join(' ', met));
    }

    /// <summary>
    /// A collapse takes in only bodies that one impact struck: when it took in every body that touched, a heal that moved one of them missed it.
    /// And it takes in the same, whichever of them is asked first, and has the key of what is struck in its round: when that was not so, two
    /// impacts of a round undid each other for ever.
    /// </summary>
    [Theory]
    [InlineData(20_006)]
    [InlineData(20_253)]
    [InlineData(500_049)]
    public void Run_CollapseInAHeap_IsHealed(ulong seed) => Assert.Empty(Run(new CheckOptions { Sessions = 1, Seed = seed, ShrinkingPlays = 0 }).Failures);

    /// <summary>
    /// A client whose copy begins within a step in which a hand pressed a ball against a wall: it knows the hand's path from a later piece
    /// on, and struck the ball against the wall once more.
    /// </summary>
    [Fact]
    public void Run_ClientWhoseCopyBeginsWhileAHandPresses_HasTheSameBits() =>
        Assert.Empty(Run(new CheckOptions { Sessions = 1, Seed = 6_628, ShrinkingPlays = 0 }).Failures);

    /// <summary>
    /// A player whose link carries 12 to 18 kbit/s and falls to a fifth for five of every few seconds gets in. It did not while a host gave a copy no longer than it takes at 1,000
    /// bytes a second, a link did not count round trips above 10 s and so saw no queue, and every event had a datagram of its own.
    /// </summary>
    [Theory]
    [InlineData(502_977UL)]
    [InlineData(310_675UL)]
    [InlineData(2_007_019UL)]
    public void Run_PlayerWhoseLinkCarriesLittle_GetsIn(ulong seed) =>
        Assert.Empty(Run(new CheckOptions { Sessions = 1, Seed = seed, Rules = RulesOfSessions.None, ShrinkingPlays = 0 }).Failures);

    /// <summary>A session that takes more events than it may is named, and no failure; the control may take them.</summary>
    [Fact]
    public void Run_SessionOfTooManyEvents_IsUnfinished()
    {
        CheckOptions options = new() { Sessions = 2, Seed = 1, ShrinkingPlays = 0, MaxEvents = 300 };
        CheckReport report = Run(options);
        Assert.Equal([1UL, 2UL], report.UnfinishedSeeds);
        Assert.Empty(report.Failures);
        Assert.Equal(0, report.Outcomes.Sum(o => o.Compared));
        CheckReport control = Run(options with { MaxEvents = 1_000_000 });
        Assert.Empty(control.UnfinishedSeeds);
        Assert.True(control.Outcomes.All(o => o.Compared > 0));
    }

    [Fact]
    public void Run_OneAtATimeOrTwo_IsTheSame()
    {
        CheckOptions options = new() { Sessions = 6, Seed = 40 };
        string[] once = Texts(Run(options with { Workers = 1 }));
        Assert.Equal(once, Texts(Run(options with { Workers = 2 })));
        Assert.Equal(6, once.Distinct().Count());
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
        // Half a second there, and the host waits three tenths of one at the most: it refuses spawns and grabs of clients, and their senders retract them.
        CheckOptions options = new() { Sessions = 3, Profile = LinkProfiles.PureDelay(500), ShrinkingPlays = 0, History = SimDuration.FromMilliseconds(100) };
        CheckReport report = Run(options);
        Assert.Equal([1UL, 2, 3], report.Failures.Select(f => f.Whole.Seed));
        Assert.All(report.Outcomes, o => Assert.Equal((true, $"{o.TooLateEvents} events were too late."), (o.TooLateEvents > 0, o.Failure)));
        Assert.Equal(0, report.DifferingBits);

        // The control: with the history that such a link needs none of them is, nor with half of it, since the host waits for what was promised.
        foreach (SimDuration? history in new SimDuration?[] { null, SimDuration.FromMilliseconds(250) })
        {
            CheckReport whole = Run(options with { History = history });
            Assert.Equal((0, 0L, 0L), (whole.Failures.Count, whole.TooLateEvents, whole.DifferingBits));
        }
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
        CheckOptions options = new()
        {
            FromPeers = 3,
            ToPeers = 3,
            PrepareSession = (_, session) => session.Begun += () => begun += StopAtTheSecond(),
        };
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
    [Trait("Time", "real")]
    public void Run_AskedToStopWhileAPeersWorldComesToNoEnd_EndsAndNamesTheSeed()
    {
        const ulong Endless = 2;
        Assert.Null(CheckSession.Play(Endless, new CheckOptions(), TestContext.Current.CancellationToken).Failure); // by itself it ends
        CheckCase drawn = new(Endless, new CheckOptions());
        using CancellationTokenSource stop = new();
        CheckOptions options = new()
        {
            Sessions = 100,
            Seed = Endless - 1,
            Workers = 1,
            PrepareSession = (peer, session) => session.Begun += () => Disturb(peer, session.World!.Simulation),
        };
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
}
