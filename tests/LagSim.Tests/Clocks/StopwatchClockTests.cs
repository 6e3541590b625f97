using System;
using System.Numerics;
using LagSim.Hosting;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Clocks;

public class StopwatchClockTests
{
    [Theory]
    [InlineData(1_000_000_000L)]
    [InlineData(10_000_000L)]
    [InlineData(24_000_000L)]
    [InlineData(3_579_545L)]
    [InlineData(1L << 42)]
    public void ToTicks_AnyReadingWithin90Days_IsTheExactQuotient(long frequency)
    {
        Random random = new(3);
        for (int i = 0; i < 10_000; i++)
        {
            BigInteger most = BigInteger.Min((BigInteger)frequency * 90 * 86400, long.MaxValue);
            long counts = random.NextInt64((long)most);
            Assert.Equal((long)(((BigInteger)counts << 40) / frequency), StopwatchClock.ToTicks(counts, frequency));
        }
    }

    [Fact]
    public void ToTicks_Beyond97Days_Throws() =>
        Assert.Throws<OverflowException>(() => StopwatchClock.ToTicks(98L * 86400 * 1_000_000_000, 1_000_000_000));

    [Fact]
    public void Now_ReadAgainAndAgain_NeverGoesBack()
    {
        StopwatchClock clock = new(SimDuration.FromSeconds(1.24));
        SimTime last = SimTime.FromSeconds(1.24);
        for (int i = 0; i < 100_000; i++)
        {
            SimTime now = clock.Now;
            Assert.True(now >= last);
            last = now;
        }
    }
}
