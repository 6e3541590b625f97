using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Harness.Reports.Charts;
using Xunit;

namespace LagSim.Tests.Charts;

public sealed class DecimationTests
{
    [Fact]
    public void Thin_LongSeries_KeepsThePeaksAndTheEnds()
    {
        (double[] x, double[] y) = Sine(100_003);
        y[54_321] = 50.0;
        y[54_322] = -60.0;

        List<(double X, double Y)> points = Decimation.Thin(x, y);

        Assert.InRange(points.Count, 1000, Decimation.MaxPoints + 2);
        Assert.Contains((x[54_321], 50.0), points);
        Assert.Contains((x[54_322], -60.0), points);
        Assert.Equal((x[0], y[0]), points[0]);
        Assert.Equal((x[^1], y[^1]), points[^1]);
        Assert.True(points.Zip(points.Skip(1)).All(pair => pair.First.X < pair.Second.X), "the points are in order");
    }

    [Fact]
    public void Thin_ShortSeries_KeepsAll()
    {
        (double[] x, double[] y) = Sine(Decimation.MaxPoints);

        Assert.Equal(x.Zip(y), Decimation.Thin(x, y));
    }

    [Fact]
    public void Thin_LongSeriesWithOneNaN_BreaksThereAndOnlyThere()
    {
        (double[] x, double[] y) = Sine(50_000);
        y[20_007] = double.NaN;

        List<(double X, double Y)> points = Decimation.Thin(x, y);

        int gap = Assert.Single(Enumerable.Range(0, points.Count), i => double.IsNaN(points[i].Y));
        Assert.True(points[gap - 1].X < x[20_007] && points[gap + 1].X > x[20_007]);
    }

    [Fact]
    public void Thin_EveryOtherValueNaN_StaysBounded()
    {
        (double[] x, double[] y) = Sine(1_000_000);
        for (int i = 0; i < y.Length; i += 2)
        {
            y[i] = double.NaN;
        }

        Assert.InRange(Decimation.Thin(x, y).Count, 1000, (2 * Decimation.MaxPoints) + 4);
    }

    [Fact]
    public void Thin_NothingButNaN_DrawsNothing()
    {
        double[] x = Enumerable.Range(0, 10_000).Select(i => (double)i).ToArray();
        double[] y = Enumerable.Repeat(double.NaN, x.Length).ToArray();

        Assert.All(Decimation.Thin(x, y), point => Assert.True(double.IsNaN(point.Y)));
    }

    private static (double[] X, double[] Y) Sine(int count)
    {
        double[] x = Enumerable.Range(0, count).Select(i => i / 1000.0).ToArray();
        return (x, x.Select(Math.Sin).ToArray());
    }
}
