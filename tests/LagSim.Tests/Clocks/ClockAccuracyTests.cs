using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using LagSim.Net.Clocks;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Clocks;

/// <summary>Estimates against the truth, which only a test knows. The path's asymmetry is what no estimate can know.</summary>
public sealed class ClockAccuracyTests
{
    private const int Seeds = 10;

    private static readonly double[] Drifts = [20, 100, -100];

    /// <summary>Every profile, and how far off an estimate may be after 30 s at p99, in milliseconds: busy, idle. The ladder has no jitter.</summary>
    public static TheoryData<string, double, double> Profiles
    {
        get
        {
            TheoryData<string, double, double> data = new()
            {
                { "loopback", 0.012, 0.015 }, { "lan", 0.06, 0.07 }, { "skewed-clock", 0.06, 0.07 }, { "wifi-good", 0.06, 0.7 }, { "wifi-busy", 1.2, 3.5 },
                { "4g", 22, 24 }, { "3g", 35, 42 }, { "5g", 5, 8 }, { "starlink", 5, 11 }, { "transatlantic", 1.2, 1.4 }, { "eu-australia", 3.3, 4.5 },
                { "satellite", 11, 17 }, { "awful", 50, 75 }, { "blackout", 2.4, 2.8 },
                { "dsl-256k", 2.4, 2.7 }, { "modem-64k", 6, 6.8 }, { "bufferbloat", 2.4, 2.7 }, { "dip", 2.4, 2.7 }, // for what is said of the clock alone, without a transfer
            };
            foreach (LinkProfile rung in LinkProfiles.Ladder)
            {
                data.Add(rung.Name, 1e-4, 1e-4);
            }

            Assert.Equal(LinkProfiles.All.Select(p => p.Name), data.Select(row => row.Data.Item1));
            return data;
        }
    }

    [Theory]
    [MemberData(nameof(Profiles))]
    public void Estimate_OnEveryProfile_IsWithinItsBoundAlwaysAndNearAfterHalfAMinute(string profile, double busyMilliseconds, double idleMilliseconds)
    {
        LinkProfile link = Profile(profile);
        foreach (bool busy in new[] { true, false })
        {
            List<ClockPair.Sample> late = [];
            foreach ((ClockPair pair, ClockSync sync) in Pairs(link, busy))
            {
                foreach (ClockPair.Sample sample in pair.Follow(sync))
                {
                    Assert.True(sample.IsWithinBound, $"{sample.Error} is beyond {sample.Bound} at {sample.TrueTime}, drift {pair.Drift}");
                    if (sample.TrueTime >= SimTime.FromSeconds(30))
                    {
                        late.Add(sample);
                    }
                }

                Assert.Equal((0, 0), (sync.RefusedCount, sync.RestartCount));
            }

            Percentiles errors = ClockPair.Errors(late), bounds = Percentiles.Of(late.Select(s => s.Bound.ToMilliseconds()));
            TestContext.Current.TestOutputHelper?.WriteLine(FormattableString.Invariant(
                $"{profile} {(busy ? "busy" : "idle")}: off by {errors.P50:0.####} / {errors.P99:0.####} / {errors.Max:0.####} ms, bound {bounds.P50:0.####} / {bounds.Max:0.####} ms"));
            Assert.InRange(errors.P99, 0, busy ? busyMilliseconds : idleMilliseconds);

            // The bound is worth something: about half a round trip, and 600 millionths of it and of the age of the
            // best exchange where the drift cannot be known better: a second, or 2 s of silence.
            double age = busy ? 1.1 : 2.1;
            Assert.InRange(bounds.Max, 0, (link.RoundTripMilliseconds / 2) + (3 * link.ToHost.JitterMilliseconds) + (0.6 * (age + (link.RoundTripMilliseconds / 1000))) + 0.1);
        }
    }

    [Theory]
    [InlineData("loopback")]
    [InlineData("lan")]
    [InlineData("awful")]
    public void IsWithinBound_OfAQuarterOfTheBound_IsSeenToFail(string profile)
    {
        // Negative control: the check above can fail, and the bound is not just large.
        int beyond = Pairs(Profile(profile), false).Sum(p => p.Pair.Follow(p.Sync).Count(s => Math.Abs(s.Error.ToSeconds()) > s.Bound.ToSeconds() / 4));
        Assert.True(beyond > 20, $"{beyond}");
    }

    [Fact]
    public void Estimate_UnevenLinksOfAllKinds_IsWithinItsBound()
    {
        // The bound holds for every path, whatever its two directions do.
        Random random = new(23);
        for (ulong seed = 1; seed <= 200; seed++)
        {
            ClockPair pair = new(new LinkProfile("uneven", Leg(random), Leg(random)), (random.NextDouble() * 980) - 490, random.Next(2) == 0, seed, 40);
            ClockSync sync = new();
            Assert.All(pair.Follow(sync), s => Assert.True(s.IsWithinBound, $"seed {seed}: {s.Error} is beyond {s.Bound} at {s.TrueTime}"));
            Assert.Equal(0, sync.RestartCount);
        }

        static LinkLeg Leg(Random random) => new(Math.Pow(10, (random.NextDouble() * 4) - 1.5), Math.Pow(10, (random.NextDouble() * 3) - 2), reorderPercent: 5);
    }

    [Fact]
    public void Estimate_OneAndAQuarterSecondsAheadOnLoopback_AgreesFarBelowAMillisecond()
    {
        for (ulong seed = 1; seed <= Seeds; seed++)
        {
            ClockPair pair = new(LinkProfiles.Loopback, 0, false, seed);
            List<ClockPair.Sample> samples = pair.Follow(new ClockSync()).ToList();
            Assert.All(samples, s => Assert.Equal(ClockPair.Ahead, s.Truth));
            Assert.InRange(ClockPair.Errors(samples).Max, 0, 0.03); // from the eighth exchange on
        }
    }

    [Theory]
    [InlineData(100)]
    [InlineData(-100)]
    public void Estimate_ClocksThatDriftOnLan_CostsMicrosecondsAfterHalfAMinute(double drift)
    {
        for (ulong seed = 1; seed <= Seeds; seed++)
        {
            foreach (bool busy in new[] { true, false })
            {
                // The same luck without drift: what is left of the error is the link's jitter.
                ClockPair steady = new(LinkProfiles.Lan, 0, busy, seed), drifting = new(LinkProfiles.Lan, drift, busy, seed);
                List<ClockPair.Sample> before = steady.Follow(new ClockSync(), 30).ToList(), after = drifting.Follow(new ClockSync(), 30).ToList();
                for (int i = 0; i < after.Count; i++)
                {
                    Assert.InRange((after[i].Error - before[i].Error).ToMilliseconds(), -0.01, 0.01);
                    Assert.InRange(after[i].Estimate.DriftPartsPerMillion, drift - 4, drift + 4);
                    Assert.InRange(Math.Abs(after[i].Estimate.DriftPartsPerMillion - drift), 0, after[i].Estimate.DriftErrorBound);
                }

                Percentiles errors = ClockPair.Errors(after);
                Assert.InRange(errors.P50, 0, 0.05);
                Assert.InRange(errors.Max, 0, 0.08);
            }
        }
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Estimate_QueuesInOneDirectionOnly_DoNotBendTheDrift(bool requests)
    {
        // Four of ten idle exchanges wait up to 20 ms on one way, and more and more do so: a line through all alike would take that for drift.
        for (ulong seed = 1; seed <= Seeds; seed++)
        {
            ClockPair pair = new(LinkProfiles.Lan, 100, false, seed);
            Random random = new((int)seed);
            ClockSync sync = new();
            foreach (ClockPair.Stamps exchange in pair.Exchanges)
            {
                SimDuration wait = random.Next(10) < 4 ? SimDuration.FromMilliseconds(random.NextDouble() * exchange.TrueBack.ToSeconds() / 6) : SimDuration.Zero;
                (requests ? exchange with { OtherReceive = exchange.OtherReceive + wait, OtherSend = exchange.OtherSend + wait, OwnReceive = exchange.OwnReceive + wait }
                    : exchange with { OwnReceive = exchange.OwnReceive + wait }).AddTo(sync);
                if (exchange.TrueBack > SimTime.FromSeconds(60))
                {
                    Assert.Equal(100, sync.Estimate.DriftPartsPerMillion, 12.0);
                    Assert.Equal(0, (sync.Estimate.OffsetAt(exchange.OwnReceive) - pair.TruthAt(exchange.TrueBack)).ToMilliseconds(), 0.2);
                }
            }
        }
    }

    [Fact]
    public void Estimate_TooNoisyToTell_FitsLittleDrift()
    {
        // The jitter of some 42 ms an offset would make of no drift hundreds of parts per million.
        List<double> drifts = [];
        foreach (bool busy in new[] { true, false })
        {
            for (ulong seed = 1; seed <= 20; seed++)
            {
                drifts.AddRange(new ClockPair(LinkProfiles.Awful, 0, busy, seed).Follow(new ClockSync(), 30).Select(s => Math.Abs(s.Estimate.DriftPartsPerMillion)));
            }
        }

        Percentiles of = Percentiles.Of(drifts);
        Assert.InRange(of.P50, 0, 20);
        Assert.InRange(of.P99, 0, 150);
        Assert.InRange(of.Max, 0, 200);
    }

    [Fact]
    public void Estimate_WithoutItsDrift_IsSeenToRunAwayBetweenExchanges()
    {
        // Negative control: 100 millionths of 2 s are 200 microseconds.
        ClockPair pair = new(LinkProfiles.Lan, 100, false, 1);
        List<ClockPair.Sample> samples = pair.Follow(new ClockSync(), 30).ToList();
        Percentiles without = ClockPair.Errors(samples.Select(s => s with { Estimate = new ClockEstimate(s.Estimate.At, s.Estimate.Offset) }));
        Assert.InRange(without.Max, 0.15, 0.3);
        Assert.InRange(ClockPair.Errors(samples).Max, 0, 0.08);
    }

    [Fact]
    public void Estimate_TenOneWayAndTwoHundredTheOther_IsOffByHalfTheDifferenceAndCannotKnow()
    {
        LinkProfile uneven = new("10/200", new LinkLeg(10), new LinkLeg(200)), even = new("105/105", new LinkLeg(105), new LinkLeg(105));
        foreach (double drift in new[] { 0.0, 100, -100 })
        {
            ClockPair a = new(uneven, drift, false, 1), b = new(even, drift, false, 1);
            List<ClockPair.Sample> ofUneven = a.Follow(new ClockSync(), 30).ToList(), ofEven = b.Follow(new ClockSync(), 30).ToList();
            Assert.All(ofUneven, s => Assert.Equal(-95, s.Error.ToMilliseconds(), 0.02)); // (200 - 10) / 2; 0.01 ms is what the clocks drift in the 95 ms
            Assert.All(ofEven, s => Assert.Equal(0, s.Error.ToMilliseconds(), 0.001));
            Assert.All(ofUneven.Concat(ofEven), s => Assert.InRange(s.Bound.ToMilliseconds(), 105, 106.5));
            Assert.All(ofUneven.Concat(ofEven), s => Assert.True(s.IsWithinBound));
            Assert.Equal(a.Exchanges.Count, b.Exchanges.Count);
            Assert.All(a.Exchanges.Zip(b.Exchanges), p => Assert.Equal(p.First.RoundTrip.ToSeconds(), p.Second.RoundTrip.ToSeconds(), 1e-11));
        }
    }

    [Fact]
    public void Exchanges_OfAnUnevenPathAndOfAnEvenOneWithAnotherOffset_AreTheSameNumbers()
    {
        // Whoever told the two apart would have to do so from equal input: the true offsets differ by 95 ms, the readings not by a tick.
        SimDuration millisecond = SimDuration.FromMilliseconds(1);
        for (int i = 0; i < 100; i++)
        {
            SimTime sent = SimTime.Zero + (millisecond * 20 * i);
            Assert.Equal(Readings(sent, 10, 200, ClockPair.Ahead), Readings(sent, 105, 105, ClockPair.Ahead - (millisecond * 95)));
        }

        (SimTime, SimTime, SimTime) Readings(SimTime sent, int up, int down, SimDuration ahead) =>
            (sent, sent + (millisecond * up) + ahead, sent + (millisecond * (up + down)));
    }

    [Theory]
    [InlineData(5)]
    [InlineData(-3)]
    [InlineData(0.01)]
    public void Estimate_OwnClockStepped_IsRightAgainWithTheNextExchange(double stepSeconds)
    {
        // Behind: a laptop whose clock stands still while it sleeps.
        ClockPair pair = new(LinkProfiles.Lan, 50, false, 3);
        ClockSync sync = new();
        SimDuration step = SimDuration.FromSeconds(stepSeconds);
        foreach (ClockPair.Stamps exchange in pair.Exchanges)
        {
            bool after = exchange.TrueBack > SimTime.FromSeconds(60.1);
            SimDuration shift = after ? step : SimDuration.Zero;
            (exchange with { OwnSend = exchange.OwnSend + shift, OwnReceive = exchange.OwnReceive + shift }).AddTo(sync);
            SimDuration error = sync.Estimate.Offset - (pair.TruthAt(exchange.TrueBack) - shift);
            Assert.True(error <= sync.Estimate.ErrorBound && -error <= sync.Estimate.ErrorBound, $"{error} at {exchange.TrueBack}");
            Assert.InRange(sync.Estimate.ErrorBound.ToMilliseconds(), 0, 0.6);
            Assert.Equal(after ? 1 : 0, sync.RestartCount);
        }

        Assert.Equal(50, sync.Estimate.DriftPartsPerMillion, 4.0); // fitted anew
    }

    [Fact]
    public void Estimate_StepTooSmallToContradict_IsGoneWithTheWindow()
    {
        ClockPair pair = new(new LinkProfile("far", new LinkLeg(100, 5)), 0, false, 4, 200);
        ClockSync sync = new();
        SimDuration step = SimDuration.FromMilliseconds(50);
        double worst = 0;
        foreach (ClockPair.Stamps exchange in pair.Exchanges)
        {
            SimDuration shift = exchange.TrueBack > SimTime.FromSeconds(100) ? step : SimDuration.Zero;
            (exchange with { OwnSend = exchange.OwnSend + shift, OwnReceive = exchange.OwnReceive + shift }).AddTo(sync);
            double error = Math.Abs((sync.Estimate.Offset - (pair.TruthAt(exchange.TrueBack) - shift)).ToMilliseconds());
            worst = Math.Max(worst, error);
            if (exchange.TrueBack > SimTime.FromSeconds(163))
            {
                Assert.InRange(error, 0, 12);
            }
        }

        Assert.Equal(0, sync.RestartCount);
        Assert.InRange(worst, 20, 60); // it did see the step late
    }

    [Fact]
    public void Estimate_OwnClockChangesItsRate_IsNoticedAndFittedAnew()
    {
        // As when the system begins to bend its clock: 400 parts per million more, from 60 s on.
        ClockPair pair = new(LinkProfiles.Lan, 50, false, 5, 180);
        ClockSync sync = new();
        foreach (ClockPair.Stamps exchange in pair.Exchanges)
        {
            (exchange with { OwnSend = Bent(exchange.OwnSend), OwnReceive = Bent(exchange.OwnReceive) }).AddTo(sync);
        }

        Assert.InRange(sync.RestartCount, 1, 3);
        Assert.Equal(-350, sync.Estimate.DriftPartsPerMillion, 4.0);
        SimTime end = pair.Exchanges[^1].TrueBack;
        Assert.Equal(0, (sync.Estimate.Offset - (pair.Other.ReadingAt(end) - Bent(pair.Own.ReadingAt(end)))).ToMilliseconds(), 0.08);

        static SimTime Bent(SimTime reading)
        {
            SimDuration since = reading - SimTime.FromSeconds(67);
            return since > SimDuration.Zero ? reading + (since / 2500) : reading;
        }
    }

    [Fact]
    public void Estimate_DriftThatWanders_IsWithinItsBound()
    {
        // Two parts per million to and fro within two minutes.
        for (ulong seed = 1; seed <= Seeds; seed++)
        {
            ClockPair pair = new(LinkProfiles.Loopback, 50, seed % 2 == 0, seed, 300);
            ClockSync sync = new();
            foreach (ClockPair.Stamps exchange in pair.Exchanges)
            {
                (exchange with { OwnSend = Wandering(exchange.OwnSend), OwnReceive = Wandering(exchange.OwnReceive) }).AddTo(sync);
                SimDuration error = sync.Estimate.Offset - (pair.Other.ReadingAt(exchange.TrueBack) - Wandering(pair.Own.ReadingAt(exchange.TrueBack)));
                Assert.True(error <= sync.Estimate.ErrorBound && -error <= sync.Estimate.ErrorBound, $"{error} at {exchange.TrueBack}");
            }

            Assert.Equal(0, sync.RestartCount);
        }

        static SimTime Wandering(SimTime reading) => reading + SimDuration.FromSeconds(2e-6 * 120 / Math.Tau * Math.Sin(Math.Tau * reading.ToSeconds() / 120));
    }

    [Fact]
    public void Estimate_DriftNoClockHas_IsNotFittedButFollowed()
    {
        ClockPair pair = new(LinkProfiles.Lan, 5_000, false, 6);
        ClockSync sync = new();
        foreach (ClockPair.Stamps exchange in pair.Exchanges)
        {
            exchange.AddTo(sync);
            Assert.InRange(Math.Abs(sync.Estimate.DriftPartsPerMillion), 0, ClockEstimate.MaxDrift);
            Assert.Equal(0, (sync.Estimate.Offset - pair.TruthAt(exchange.TrueBack)).ToMilliseconds(), 0.6);
        }

        Assert.True(sync.RestartCount > 40, $"{sync.RestartCount}");
    }

    [Fact]
    public void Add_AnyFourReadings_NeverThrowsNorMakesAnEstimateThatNoClockTakes()
    {
        Random random = new(29);
        for (int i = 0; i < 300; i++)
        {
            ClockSync sync = new(1);
            SharedClock shared = new(new ManualClock());
            for (int k = 0; k < 300; k++)
            {
                SimTime own = Any(random), other = Any(random);
                SimDuration length = Short(random), held = Short(random);
                if (sync.Add(own, other, SaturatingAdd(other, held), SaturatingAdd(own, length)))
                {
                    shared.Adjust(sync.Estimate);
                    Assert.True(sync.Estimate.ErrorBound > SimDuration.Zero && sync.RoundTrip >= SimDuration.Zero);
                }
            }

            Assert.True(sync.SampleCount > 0 && sync.RestartCount > 0);
        }

        static SimTime Any(Random random) => SimTime.FromTicks(random.NextInt64(long.MinValue, long.MaxValue) >> random.Next(0, 62));
        static SimDuration Short(Random random) => SimDuration.FromTicks(random.NextInt64(-1L << 20, 1L << random.Next(21, 47)));
        static SimTime SaturatingAdd(SimTime time, SimDuration span) => SimTime.FromTicks((long)Int128.Clamp((Int128)time.Ticks + span.Ticks, long.MinValue, long.MaxValue));
    }

    [Fact]
    public void Estimate_SameReadingsTwice_IsTheSameToTheTick()
    {
        Assert.Equal(Trace(), Trace());

        static IEnumerable<(SimDuration, double, SimDuration)> Trace() => new ClockPair(LinkProfiles.Awful, 100, true, 8)
            .Follow(new ClockSync()).Select(s => (s.Estimate.Offset, s.Estimate.DriftPartsPerMillion, s.Bound)).ToList();
    }

    private static LinkProfile Profile(string name) =>
        LinkProfiles.TryGet(name, out LinkProfile? profile, out string? error) ? profile : throw new ArgumentException(error);

    private static IEnumerable<(ClockPair Pair, ClockSync Sync)> Pairs(LinkProfile link, bool busy) =>
        from seed in Enumerable.Range(1, Seeds)
        from drift in Drifts
        select (new ClockPair(link, drift, busy, (ulong)seed), new ClockSync());
}
