using System;
using LagSim.Harness.Experiments.Metrics;
using Xunit;

namespace LagSim.Tests.Metrics;

public sealed class ErrorAccumulatorTests
{
    [Fact]
    public void ToStatistics_WithoutSamples_IsAllZero()
    {
        Assert.Equal(ErrorStatistics.None, new ErrorAccumulator().ToStatistics());
    }

    [Fact]
    public void ToStatistics_OfThreeFourZero_MatchesHandValues()
    {
        ErrorAccumulator errors = new();
        errors.Add(3.0, anyBitDiffers: true);
        errors.Add(0.0, anyBitDiffers: false);
        errors.Add(4.0, anyBitDiffers: true);
        errors.Add(0.0, anyBitDiffers: true); // -0.0 against 0.0: no distance, yet not the same bits
        errors.AddStalled();

        ErrorStatistics statistics = errors.ToStatistics();

        Assert.Equal(4, statistics.Samples);
        Assert.Equal(4.0, statistics.MaxMetres);
        Assert.Equal(1.75, statistics.MeanMetres, 1e-15);
        Assert.Equal(2.5, statistics.RmsMetres, 1e-15); // sqrt((9 + 16) / 4)
        Assert.Equal(3, statistics.DifferingBits);
        Assert.Equal(1, statistics.StalledSamples);
    }

    /// <summary>A measure that is always small would pass every test of agreement: it must see one bad sample in many good ones.</summary>
    [Fact]
    public void ToStatistics_OneBadSampleAmongMany_ShowsIt()
    {
        ErrorAccumulator good = new(), bad = new();
        for (int i = 0; i < 9999; i++)
        {
            good.Add(0.0, anyBitDiffers: false);
            bad.Add(0.0, anyBitDiffers: false);
        }

        bad.Add(5.0, anyBitDiffers: true);

        Assert.Equal(0.0, good.ToStatistics().MaxMetres);
        Assert.Equal(0.0, good.ToStatistics().RmsMetres);
        Assert.Equal(0, good.ToStatistics().DifferingBits);
        Assert.Equal(5.0, bad.ToStatistics().MaxMetres);
        Assert.Equal(0.05, bad.ToStatistics().RmsMetres, 1e-12);
        Assert.Equal(5e-4, bad.ToStatistics().MeanMetres, 1e-14);
        Assert.Equal(1, bad.ToStatistics().DifferingBits);
    }

    [Fact]
    public void ToStatistics_OnlyStalledSamples_CountsThemAndNothingElse()
    {
        ErrorAccumulator errors = new();
        errors.AddStalled();
        errors.AddStalled();

        Assert.Equal(new ErrorStatistics(0, 0.0, 0.0, 0.0, 0, 2), errors.ToStatistics());
    }

    [Fact]
    public void ToStatistics_ConstantError_RmsIsThatErrorToTheBit()
    {
        ErrorAccumulator errors = new();
        for (int i = 0; i < 1000; i++)
        {
            errors.Add(0.1, anyBitDiffers: true);
        }

        Assert.Equal(0.1, errors.ToStatistics().RmsMetres);
        Assert.Equal(0.1, errors.ToStatistics().MeanMetres);
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(-1e-300)]
    public void Add_NotAnError_Throws(double value)
    {
        Assert.Throws<ArgumentOutOfRangeException>(() => new ErrorAccumulator().Add(value, anyBitDiffers: false));
    }

    [Fact]
    public void PhaseErrors_ByPhase_AreKeptApart()
    {
        PhaseErrors errors = new();
        errors[Phase.During].Add(2.0, anyBitDiffers: true);

        Assert.Same(errors.Before, errors[Phase.Before]);
        Assert.Same(errors.After, errors[Phase.After]);
        Assert.Equal(1, errors.During.ToStatistics().Samples);
        Assert.Equal(0, errors.Before.ToStatistics().Samples);
        Assert.Equal(0, errors.After.ToStatistics().Samples);
        Assert.Throws<ArgumentOutOfRangeException>(() => errors[(Phase)3]);
    }
}
