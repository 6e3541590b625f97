using System;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Testing.Links;
using LagSim.Tests.Api;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class ClockTests
{
    private static readonly long Day = SimDuration.FromSeconds(86_400).Ticks;

    [Fact]
    public void VirtualClock_SetForwardOrBack_MovesOrIsRefused()
    {
        VirtualClock clock = new(SimTime.FromSeconds(1));
        clock.Now = SimTime.FromSeconds(2);
        clock.Now = SimTime.FromSeconds(2);
        Assert.Throws<ArgumentOutOfRangeException>(() => clock.Now = SimTime.FromSeconds(1.5));
        Assert.Equal(SimTime.FromSeconds(2), clock.Now);
    }

    [Fact]
    public void SkewedClock_OffsetAndSkew_ReadsTheProduct()
    {
        VirtualClock trueClock = new();
        SkewedClock fast = new(trueClock, 100, SimDuration.FromSeconds(1.24));
        Assert.Equal(SimTime.FromSeconds(1.24), fast.Now);
        trueClock.Now = SimTime.FromSeconds(1000);
        Assert.InRange(fast.Now.ToSeconds(), 1001.34 - 1e-8, 1001.34 + 1e-8);
        Assert.Equal(trueClock.Now, new SkewedClock(trueClock, 0, SimDuration.Zero).Now);
    }

    [Fact]
    public void SkewedClock_AnyTimes_NeverGoesBack()
    {
        Prop.ForAll(Cases(), c =>
        {
            SkewedClock clock = Clock(c);
            SimTime now = SimTime.FromTicks(c.Ticks);
            return clock.ReadingAt(now) <= clock.ReadingAt(now + SimDuration.OneTick);
        }).QuickCheckThrowOnFailure();
    }

    [Fact]
    public void TrueTimeOf_AnyReading_IsTheFirstTimeAtWhichTheClockReadsIt()
    {
        Prop.ForAll(Cases(), c =>
        {
            SkewedClock clock = Clock(c);
            SimTime reading = SimTime.FromTicks(c.Ticks), at = clock.TrueTimeOf(reading);
            return clock.ReadingAt(at) >= reading && clock.ReadingAt(at - SimDuration.OneTick) < reading;
        }).QuickCheckThrowOnFailure();
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(100_001)]
    [InlineData(double.NegativeInfinity)]
    public void SkewedClock_SkewOutOfRange_IsRefused(double partsPerMillion)
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new SkewedClock(new VirtualClock(), partsPerMillion, SimDuration.Zero));
    }

    private static SkewedClock Clock((long Ticks, int Ppm, long Offset) c) =>
        new(new VirtualClock(), c.Ppm, SimDuration.FromTicks(c.Offset));

    private static Arbitrary<(long Ticks, int Ppm, long Offset)> Cases() =>
        (from ticks in TickGenerators.Any
         from ppm in Gen.Choose(-100_000, 100_000)
         from offset in TickGenerators.Any
         select (ticks % (10 * Day), ppm, offset % Day)).ToArbitrary();
}
