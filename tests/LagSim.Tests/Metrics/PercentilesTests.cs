using System;
using System.Linq;
using LagSim.Harness.Experiments.Metrics;
using Xunit;

namespace LagSim.Tests.Metrics;

public sealed class PercentilesTests
{
    [Fact]
    public void Of_Nothing_IsZero()
    {
        Assert.Equal(new Percentiles(0.0, 0.0, 0.0), Percentiles.Of([]));
    }

    [Fact]
    public void Of_OneValue_IsThatValueThrice()
    {
        Assert.Equal(new Percentiles(7.5, 7.5, 7.5), Percentiles.Of([7.5]));
    }

    [Fact]
    public void Of_OneToHundredShuffled_MatchesNumPy()
    {
        Percentiles percentiles = Percentiles.Of(Enumerable.Range(0, 100).Select(i => 1.0 + (i * 37 % 100)));

        Assert.Equal(50.5, percentiles.P50, 1e-12); // numpy.percentile(range(1, 101), [50, 99])
        Assert.Equal(99.01, percentiles.P99, 1e-12);
        Assert.Equal(100.0, percentiles.Max);
    }

    [Fact]
    public void MeanAndTail_OfOneToHundred_MatchesNumPy()
    {
        MeanAndTail of = MeanAndTail.Of(Enumerable.Range(1, 100).Select(i => (double)i).ToArray());
        Assert.Equal((50.5, 99.01), (of.Mean, of.P99));
        Assert.Equal(default, MeanAndTail.Of([]));
    }

    [Fact]
    public void Of_NaN_Throws()
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => Percentiles.Of([1.0, double.NaN]));
    }
}
