using System;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Testing.Links;
using LagSim.Tests.Api;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class CadenceTests
{
    [Fact]
    public void At_AnyTimePeriodAndPhase_IsTheNumberAndRestOfTheDivision()
    {
        Prop.ForAll(Cases(), c =>
        {
            SimDuration period = SimDuration.FromTicks(c.Period);
            long number = new Cadence(period, c.Phase / 1000.0).At(SimTime.FromTicks(c.Ticks), out SimDuration into);
            Int128 lead = (long)(c.Phase / 1000.0 * c.Period);
            return into >= SimDuration.Zero && into < period && ((Int128)number * c.Period) + into.Ticks - lead == c.Ticks;
        }).Check(Config.QuickThrowOnFailure.WithMaxTest(2000));
    }

    [Theory]
    [InlineData(0, 0, 10)]
    [InlineData(5, 1, 0)]
    [InlineData(19.5, 1, 14.5)]
    [InlineData(20, 2, 0)]
    [InlineData(-0.5, 0, 9.5)]
    [InlineData(-10.5, -1, 14.5)]
    public void At_EveryFifteenSecondsFromTheFifth_SaysWhichAndHowLong(double seconds, long number, double into)
    {
        // Two thirds of number 0 have gone by at time zero.
        Assert.Equal(number, new Cadence(SimDuration.FromSeconds(15), 10 / 15.0).At(SimTime.FromSeconds(seconds), out SimDuration since));
        TestWorlds.Near(into, since.ToSeconds(), 1e-11);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(0.0009)]
    [InlineData(86_401)]
    [InlineData(double.NaN)]
    public void Period_OutOfRange_IsRefused(double seconds)
    {
        Assert.Equal("periodSeconds", Assert.Throws<ArgumentOutOfRangeException>(() => new DelayStep(seconds, 1)).ParamName);
        Assert.Equal("periodSeconds", Assert.Throws<ArgumentOutOfRangeException>(() => new PeriodicOutage(seconds, 1e-4)).ParamName);
    }

    private static Arbitrary<(long Ticks, long Period, int Phase)> Cases() =>
        (from ticks in TickGenerators.Any
         from period in Gen.Choose(1, 86_400_000)
         from phase in Gen.Choose(0, 999)
         select (ticks, SimDuration.FromMilliseconds(period).Ticks, phase)).ToArbitrary();
}
