using System;
using LagSim.Testing.Links;
using MathNet.Numerics.Distributions;
using Xunit;

namespace LagSim.Tests.Links;

/// <summary>The quantile that long tails are drawn with, against another implementation.</summary>
public sealed class NormalQuantileTests
{
    [Fact]
    public void Of_AnyShareOfALongTail_IsTheLibrarys()
    {
        for (double percent = 0.001; percent <= 99.999; percent += 0.0173)
        {
            double share = 1 - (percent / 100);
            double expected = Normal.InvCDF(0, 1, share);
            Assert.True(Math.Abs(expected - NormalQuantile.Of(share)) < 1e-13, $"{share} {expected} {NormalQuantile.Of(share)}");
        }
    }

    [Fact]
    public void LogDeviation_OfTheTailsOfTheProfiles_IsToTheBitWhatTheLibraryGives()
    {
        foreach ((LongTail tail, double median) in new[] { (new LongTail(1, 125), 1.5), (new LongTail(10, 50), 10.0), (new LongTail(49, 1000), 1e-3) })
        {
            double expected = Math.Round(Math.Log(tail.AboveMilliseconds / median) / Normal.InvCDF(0, 1, 1 - (tail.Percent / 100)), 9);
            Assert.Equal(expected, tail.LogDeviation(median));
        }
    }
}
