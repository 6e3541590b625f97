using System;
using System.Linq;
using LagSim.Harness.Reports.Charts;
using Xunit;

namespace LagSim.Tests.Charts;

public sealed class AxisTests
{
    [Theory]
    [InlineData(0.0, 9.87, "0|2|4|6|8|10")]
    [InlineData(0.0, 0.00031, "0.0000|0.0001|0.0002|0.0003|0.0004")]
    [InlineData(-1.2, 1.1, "\u22121.5|\u22121.0|\u22120.5|0|0.5|1.0|1.5")]
    public void Fit_LinearValues_HasRoundTicks(double low, double high, string labels)
    {
        Axis axis = Fit(ChartScale.Linear, low, high);

        Assert.Equal(labels.Replace("0.0000", "0", StringComparison.Ordinal), Labels(axis));
    }

    [Theory]
    [InlineData(0.0)]
    [InlineData(10.0)]
    [InlineData(-3e8)]
    [InlineData(1e300)]
    [InlineData(5e-300)]
    public void Fit_OneValueOnly_PutsItInside(double value)
    {
        Axis axis = Fit(ChartScale.Linear, value);

        Assert.InRange(axis.Map(value), 0.0, axis.Length);
        Assert.InRange(axis.Ticks.Count, 1, 20);
        Assert.Equal(axis.Ticks.Count, axis.Ticks.Select(t => t.Label).Distinct().Count());
    }

    [Fact]
    public void Fit_NoValues_StillHasTicks()
    {
        Assert.NotEmpty(Fit(ChartScale.Linear).Ticks);
        Assert.NotEmpty(Fit(ChartScale.Log10).Ticks);
    }

    [Fact]
    public void Fit_LogWithZero_PutsZeroBelowTheLowestDecadeWithItsOwnLabel()
    {
        Axis axis = Fit(ChartScale.Log10, 0.0, 0.002, 3.0);

        Assert.Equal("0|0.001|0.01|0.1|1|10", Labels(axis));
        Assert.Equal(axis.Ticks[0].Pixel, axis.Map(0.0));
        Assert.True(axis.Map(0.0) > 0.0 && axis.Map(0.0) < axis.Map(0.001));
        Assert.Equal(axis.Length, axis.Map(10.0), 1e-9);
    }

    [Fact]
    public void Fit_LogWithoutZero_HasNoZero()
    {
        Axis axis = Fit(ChartScale.Log10, 0.001, 1.0);

        Assert.Equal("0.001|0.01|0.1|1", Labels(axis));
        Assert.Equal(0.0, axis.Map(0.001), 1e-9);
    }

    [Fact]
    public void Fit_LogWithFloorAboveValues_SaysLessThanAndNotZero()
    {
        Axis axis = Fit(ChartScale.Log10, [0.0, 1e-12, 1.0], floor: 1e-6);

        Assert.Equal("<10\u207b\u2076", axis.Ticks[0].Label);
        Assert.Equal(axis.Map(0.0), axis.Map(1e-12));
    }

    [Fact]
    public void Fit_LogOfZerosAlone_PutsThemOnTheZeroLine()
    {
        Axis axis = Fit(ChartScale.Log10, 0.0);

        Assert.Equal("0", axis.Ticks[0].Label);
        Assert.Equal(axis.Ticks[0].Pixel, axis.Map(0.0));
    }

    [Fact]
    public void Fit_LogOverTheWholeRangeOfDouble_KeepsEighteenDecades()
    {
        Axis axis = Fit(ChartScale.Log10, double.Epsilon, 1.0);

        Assert.StartsWith("<10", axis.Ticks[0].Label);
        Assert.InRange(axis.Ticks.Count(t => t.Label is not null), 3, 20);
    }

    [Fact]
    public void Fit_LogOfManyDecades_HasPowersOfTenOnly()
    {
        Axis axis = Fit(ChartScale.Log10, 1e-8, 1e3);

        Assert.All(axis.Ticks.Where(t => t.Label is not null), t => Assert.StartsWith("10", t.Label));
        Assert.Contains(axis.Ticks, t => t.Label == "10\u2070");
    }

    private static string Labels(Axis axis) => string.Join('|', axis.Ticks.Where(t => t.Label is not null).Select(t => t.Label));

    private static Axis Fit(ChartScale scale, params double[] values) => Fit(scale, values, null);

    private static Axis Fit(ChartScale scale, double[] values, double? floor)
    {
        ValueRange range = new();
        range.Include(values);
        return Axis.Fit(scale, range, length: 200.0, pixelsPerTick: 34.0, roundOut: true, floor);
    }
}
