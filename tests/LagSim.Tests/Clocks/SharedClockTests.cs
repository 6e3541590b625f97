using System;
using System.Collections.Generic;
using LagSim.Net.Clocks;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Clocks;

public class SharedClockTests
{
    private const double DriftRounding = 1e-4; // ms: a quarter of a part in 10^9 over minutes

    [Fact]
    public void Now_BeforeTheFirstAdjust_Throws()
    {
        SharedClock shared = new(new ManualClock());

        Assert.False(shared.IsSet);
        Assert.Throws<InvalidOperationException>(() => shared.Now);
    }

    [Fact]
    public void Adjust_First_SetsAtOnce()
    {
        ManualClock own = new() { Now = SimTime.FromSeconds(7) };
        SharedClock shared = new(own);

        shared.Adjust(SimDuration.FromSeconds(1.25));

        Assert.True(shared.IsSet);
        Assert.Equal(SimTime.FromSeconds(8.25), shared.Now);
        Assert.Equal(SimDuration.Zero, shared.Remaining);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(-1)]
    public void Now_SmallError_SlewsByHalfAPercentAndThenStays(int sign)
    {
        ManualClock own = new();
        SharedClock shared = new(own);
        shared.Adjust(SimDuration.Zero);
        SimDuration error = SimDuration.FromMilliseconds(sign * 5);
        shared.Adjust(error);

        own.Now = SimTime.FromSeconds(0.5);
        Assert.Equal(own.Now + (SimDuration.FromSeconds(0.5) / 200 * sign), shared.Now);
        own.Now = SimTime.FromSeconds(1.5);
        Assert.Equal(own.Now + error, shared.Now);
        Assert.Equal(SimDuration.Zero, shared.Remaining);
    }

    [Fact]
    public void Now_LargeError_SlewsFastUntilItIsSmall()
    {
        ManualClock own = new();
        SharedClock shared = new(own);
        shared.Adjust(SimDuration.Zero);
        shared.Adjust(SimDuration.FromMilliseconds(110));

        own.Now = SimTime.FromSeconds(1); // 50 ms made good at 5 %
        AssertNear(50, shared.Now - own.Now);
        own.Now = SimTime.FromSeconds(3); // 100 ms after 2 s, then 1 s at 0.5 %
        AssertNear(105, shared.Now - own.Now);
        own.Now = SimTime.FromSeconds(5);
        Assert.Equal(SimDuration.FromMilliseconds(110), shared.Now - own.Now);
    }

    [Fact]
    public void Now_HoweverOftenRead_RunsTheSame()
    {
        ManualClock own = new();
        SharedClock often = new(own), seldom = new(own);
        foreach (SharedClock clock in new[] { often, seldom })
        {
            clock.Adjust(SimDuration.Zero);
            clock.Adjust(new ClockEstimate(SimTime.FromSeconds(-3), SimDuration.FromMilliseconds(-30), 123));
        }

        for (int i = 1; i <= 1000; i++)
        {
            own.Now = SimTime.FromSeconds(i * 1e-3);
            _ = often.Now;
        }

        Assert.InRange((often.Now - seldom.Now).Ticks, -2000, 2000);
    }

    [Fact]
    public void Now_RandomAdjustments_IsMonotoneAndNeverBreaksTheLimit()
    {
        Random random = new(11);
        ManualClock own = new();
        SharedClock shared = new(own);
        ClockEstimate estimate = new(SimTime.Zero, SimDuration.FromSeconds(1.24));
        shared.Adjust(estimate);
        for (int i = 0; i < 100_000; i++)
        {
            SimTime ownBefore = own.Now, before = shared.Now;
            bool near = Math.Abs(shared.Remaining.Ticks) <= SharedClock.FastAbove.Ticks;
            own.Now += SimDuration.FromTicks(random.NextInt64(1L << random.Next(1, 38)));
            SimDuration drifted = estimate.OffsetAt(own.Now) - estimate.OffsetAt(ownBefore); // what is bent is bent on top of it
            Assert.True(KeepsLimit(own.Now - ownBefore, shared.Now - before - drifted, near ? 200 : 20), $"step {i}");
            Assert.True(shared.Now >= before, $"step {i}");
            if (random.Next(20) == 0)
            {
                SimTime unmoved = shared.Now;
                SimDuration offset = SimDuration.FromMilliseconds(1240 + (random.NextDouble() * random.Next(1, 100)));
                estimate = new ClockEstimate(own.Now - SimDuration.FromSeconds(random.NextDouble()), offset, (random.NextDouble() * 1000) - 500);
                shared.Adjust(estimate);
                Assert.Equal(unmoved, shared.Now); // an adjustment alone moves nothing
            }
        }
    }

    [Fact]
    public void KeepsLimit_AClockThatSteps_IsCaught()
    {
        // Negative control: following each estimate at once is what the check above must notice.
        SimDuration elapsed = SimDuration.FromMilliseconds(16);
        Assert.False(KeepsLimit(elapsed, elapsed + SimDuration.FromMilliseconds(1), 200));
        Assert.False(KeepsLimit(elapsed, elapsed - SimDuration.FromMilliseconds(1), 20));
        Assert.False(KeepsLimit(elapsed, -SimDuration.OneTick, 20));
        Assert.True(KeepsLimit(elapsed, elapsed + (elapsed / 200), 200));
    }

    [Fact]
    public void Now_OwnClockGoesBack_StandsStill()
    {
        ManualClock own = new() { Now = SimTime.FromSeconds(5) };
        SharedClock shared = new(own);
        shared.Adjust(SimDuration.Zero);
        own.Now = SimTime.FromSeconds(4);

        Assert.Equal(SimTime.FromSeconds(5), shared.Now);
    }

    [Theory]
    [InlineData(100)]
    [InlineData(-500)]
    public void Now_EstimateWithDrift_FollowsItWithoutFurtherAdjustment(double partsPerMillion)
    {
        ManualClock own = new() { Now = SimTime.FromSeconds(7) };
        SharedClock shared = new(own);
        shared.Adjust(new ClockEstimate(SimTime.FromSeconds(5), SimDuration.FromSeconds(1.24), partsPerMillion));

        AssertNear(1240 + (partsPerMillion * 2e-3), shared.Now - own.Now); // it held two seconds ago
        own.Now = SimTime.FromSeconds(605);
        AssertNear(1240 + (partsPerMillion * 0.6), shared.Now - own.Now, DriftRounding);
        AssertNear(1240 + (partsPerMillion * 0.6), shared.Offset, DriftRounding);
        Assert.Equal(SimDuration.Zero, shared.Remaining);
    }

    [Fact]
    public void Now_ErrorAndDrift_SlewsOnTopOfTheDrift()
    {
        ManualClock own = new();
        SharedClock shared = new(own);
        shared.Adjust(new ClockEstimate(SimTime.Zero, SimDuration.Zero, 100));
        shared.Adjust(new ClockEstimate(SimTime.Zero, SimDuration.FromMilliseconds(5), 200));

        own.Now = SimTime.FromSeconds(0.5);
        AssertNear(2.5 + 0.1, shared.Now - own.Now);
        AssertNear(2.5, shared.Remaining);
        own.Now = SimTime.FromSeconds(10);
        AssertNear(5 + 2, shared.Now - own.Now, DriftRounding);
    }

    [Fact]
    public void Now_ByEstimatesOnAnIdleLan_StaysNearTheTruthAndNeverGoesBack()
    {
        (double with, double without) = (FollowLan(estimate => estimate), FollowLan(e => new ClockEstimate(e.At, e.Offset)));
        Assert.InRange(with, 0, 0.08);
        Assert.InRange(without, 0.15, 0.3); // negative control: 100 millionths of the 2 s between exchanges

        static double FollowLan(Func<ClockEstimate, ClockEstimate> use)
        {
            ClockPair pair = new(LinkProfiles.Lan, 100, false, 12);
            ManualClock own = new();
            SharedClock shared = new(own);
            SimTime adjusted = SimTime.MinValue, before = SimTime.MinValue;
            List<double> errors = [];
            foreach (ClockPair.Sample sample in pair.Follow(new ClockSync()))
            {
                own.Now = sample.OwnTime;
                if (sample.Estimate.At != adjusted)
                {
                    shared.Adjust(use(sample.Estimate));
                    adjusted = sample.Estimate.At;
                }

                Assert.True(shared.Now > before);
                before = shared.Now;
                if (sample.TrueTime > SimTime.FromSeconds(30))
                {
                    errors.Add(Math.Abs((shared.Now - own.Now - sample.Truth).ToMilliseconds()));
                }
            }

            return Harness.Experiments.Metrics.Percentiles.Of(errors).Max;
        }
    }

    [Fact]
    public void Adjust_AfterTimeUnread_SlewsThatTimeTowardsTheEarlierEstimate()
    {
        ManualClock own = new();
        SharedClock shared = new(own);
        shared.Adjust(SimDuration.Zero);
        own.Now = SimTime.FromSeconds(100);

        shared.Adjust(SimDuration.FromMilliseconds(400));

        Assert.Equal(own.Now, shared.Now);
    }

    [Fact]
    public void Adjust_Absurd_IsRefused()
    {
        SharedClock shared = new(new ManualClock());

        Assert.Throws<ArgumentOutOfRangeException>(() => shared.Adjust(SimDuration.MaxValue));
        Assert.Throws<ArgumentOutOfRangeException>(() => shared.Adjust(new ClockEstimate(SimTime.Zero, SimDuration.FromTicks(-(1L << 62) - 1))));
        Assert.False(shared.IsSet);
    }

    [Fact]
    public void Adjust_FromOneExtremeToTheOther_DoesNotOverflow()
    {
        ManualClock own = new();
        SharedClock shared = new(own);
        shared.Adjust(SimDuration.FromTicks(-1L << 62));
        shared.Adjust(SimDuration.FromTicks((1L << 62) - 1));
        own.Now = SimTime.FromSeconds(1000);

        AssertNear(50_000, shared.Now - own.Now - SimDuration.FromTicks(-1L << 62));
    }

    private static bool KeepsLimit(SimDuration own, SimDuration shared, long share)
    {
        SimDuration bent = shared - own;
        return shared >= SimDuration.Zero && bent <= own / share && -bent <= own / share;
    }

    private static void AssertNear(double milliseconds, SimDuration actual, double tolerance = 1e-6) =>
        Assert.Equal(milliseconds, actual.ToMilliseconds(), tolerance);
}
