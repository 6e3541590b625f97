using System;
using System.Numerics;
using LagSim.Net.Clocks;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Clocks;

public class ClockEstimateTests
{
    [Fact]
    public void OffsetAt_AnyTimes_IsTheExactProductRoundedDown()
    {
        Random random = new(17);
        for (int i = 0; i < 10_000; i++)
        {
            SimTime at = SimTime.FromTicks(random.NextInt64(-1L << 61, 1L << 61)), own = SimTime.FromTicks(random.NextInt64(-1L << 61, 1L << 61));
            ClockEstimate estimate = new(at, SimDuration.FromSeconds(1.24), (random.NextDouble() * 1000) - 500);
            BigInteger drift = (BigInteger)Math.Round(estimate.DriftPartsPerMillion * 1e-6 * (1L << 32));
            Assert.Equal((long)(((own - at).Ticks * drift) >> 32), (estimate.OffsetAt(own) - estimate.Offset).Ticks);
            Assert.True(own + estimate.OffsetAt(own) <= own + SimDuration.OneTick + estimate.OffsetAt(own + SimDuration.OneTick));
        }
    }

    [Fact]
    public void OffsetAt_HundredPartsPerMillion_GrowsByThatMuch()
    {
        ClockEstimate estimate = new(SimTime.FromSeconds(10), SimDuration.FromSeconds(1.24), -100);

        Assert.Equal(SimDuration.FromSeconds(1.24), estimate.OffsetAt(SimTime.FromSeconds(10)));
        Assert.Equal(1240 - 2, estimate.OffsetAt(SimTime.FromSeconds(30)).ToMilliseconds(), 1e-4);
        Assert.Equal(1240 + 1, estimate.OffsetAt(SimTime.Zero).ToMilliseconds(), 1e-4);
    }

    [Fact]
    public void ErrorBoundAt_AwayFromItsTime_GrowsWithTheDriftsBoundBothWays()
    {
        ClockEstimate estimate = new(SimTime.FromSeconds(10), SimDuration.Zero, 0.0, SimDuration.FromMilliseconds(2), 20e-6);

        Assert.Equal(SimDuration.FromMilliseconds(2), estimate.ErrorBoundAt(estimate.At));
        Assert.Equal(2.1, estimate.ErrorBoundAt(SimTime.FromSeconds(15)).ToMilliseconds(), 1e-5);
        Assert.Equal(2.1, estimate.ErrorBoundAt(SimTime.FromSeconds(5)).ToMilliseconds(), 1e-5);
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(500.1)]
    [InlineData(double.NegativeInfinity)]
    public void Constructor_DriftNoClockHas_IsRefused(double partsPerMillion)
    {
        ArgumentOutOfRangeException refused = Assert.Throws<ArgumentOutOfRangeException>(() => new ClockEstimate(SimTime.Zero, SimDuration.Zero, partsPerMillion));
        Assert.Contains("at most 500 parts per million", refused.Message, StringComparison.Ordinal);
    }
}
