using System;
using System.Linq;
using LagSim.Testing.Links;
using MathNet.Numerics.Distributions;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class SeededRandomTests
{
    [Fact]
    public void NextUInt64_SeedZero_IsXoshiro256StarStarOfSplitMix()
    {
        // From another implementation of the two, with Python integers.
        SeededRandom random = new(0);
        Assert.Equal(11091344671253066420UL, random.NextUInt64());
        Assert.Equal(13793997310169335082UL, random.NextUInt64());
        Assert.Equal(1900383378846508768UL, random.NextUInt64());
    }

    [Fact]
    public void NextGaussian_AnyBuildOrMachine_GivesTheSameBits()
    {
        // Pinned: a build, runtime or processor that gives other bits makes every recorded result unrepeatable.
        SeededRandom random = new(2024);
        ulong hash = 14695981039346656037;
        for (int i = 0; i < 100_000; i++)
        {
            hash = (hash ^ BitConverter.DoubleToUInt64Bits(random.NextGaussian())) * 1099511628211;
        }

        Assert.Equal(3826752394201309357UL, hash);
    }

    [Fact]
    public void Log_AnyNumberBelowOne_IsThatOfThePlatformToTheLastBitsOrTwo()
    {
        SeededRandom random = new(3);
        for (int i = 0; i < 10_000; i++)
        {
            double x = random.NextDouble(1e-12, 1) * Math.Pow(2, -(i % 60));
            Bounds.Near(Math.Log(x), SeededRandom.Log(x), 1e-15 + (4e-16 * -Math.Log(x)));
        }
    }

    [Fact]
    public void Exp_AnyPower_IsThatOfThePlatformToTheLastBits()
    {
        SeededRandom random = new(4);
        for (int i = 0; i < 10_000; i++)
        {
            double x = random.NextDouble(-1, 1) * (i % 3 == 0 ? 700 : i % 3 == 1 ? 10 : 1e-9);
            Bounds.Near(1, SeededRandom.Exp(x) / Math.Exp(x), 6e-16);
        }

        Assert.Equal(
            [1, 0, double.PositiveInfinity, double.PositiveInfinity, 0, double.NaN],
            new[] { 0, -1e9, 1e9, double.PositiveInfinity, double.NegativeInfinity, double.NaN }.Select(SeededRandom.Exp));
        Bounds.Near(1, SeededRandom.Exp(709) / Math.Exp(709), 6e-16);
        Bounds.Near(1, SeededRandom.Exp(-708) / Math.Exp(-708), 6e-16);
    }

    [Fact]
    public void NextGaussian_HundredThousandDraws_FollowTheNormalDistribution()
    {
        SeededRandom random = new(1);
        double[] draws = Enumerable.Range(0, 100_000).Select(_ => random.NextGaussian()).ToArray();
        Assert.InRange(Bounds.KolmogorovDistance(draws, x => Normal.CDF(0, 1, x)), 0, Bounds.KolmogorovLimit(draws.Length));
        Assert.InRange(Correlation.Pearson(draws[..^1], draws[1..]), -Bounds.Z / Math.Sqrt(draws.Length), Bounds.Z / Math.Sqrt(draws.Length));
    }

    [Fact]
    public void NextDouble_HundredThousandDraws_AreUniformBelowOne()
    {
        SeededRandom random = new(7);
        double[] draws = Enumerable.Range(0, 100_000).Select(_ => random.NextDouble()).ToArray();
        Assert.All(draws, x => Assert.True(x is >= 0 and < 1));
        Assert.InRange(Bounds.KolmogorovDistance(draws, x => x), 0, Bounds.KolmogorovLimit(draws.Length));
    }

    [Fact]
    public void Fork_AfterAnyNumberOfDraws_IsTheSameStream()
    {
        SeededRandom fresh = new(5), used = new(5);
        used.NextGaussian();
        used.NextUInt64();
        Assert.Equal(fresh.Fork(3).NextUInt64(), used.Fork(3).NextUInt64());
    }

    [Fact]
    public void Fork_DifferentStreamsSeedsOrDepths_AllDiffer()
    {
        ulong[] firsts = Enumerable.Range(0, 1000)
            .SelectMany(i => new[]
            {
                new SeededRandom((ulong)i).NextUInt64(),
                new SeededRandom(0).Fork((ulong)i).NextUInt64(),
                new SeededRandom((ulong)i + 1).Fork(0).NextUInt64(),
                new SeededRandom(0).Fork((ulong)i).Fork((ulong)i).NextUInt64(),
            })
            .ToArray();
        Assert.Equal(firsts.Length, firsts.Distinct().Count());
    }

    [Fact]
    public void Fork_NeighbouringStreams_AreUncorrelated()
    {
        SeededRandom a = new SeededRandom(9).Fork(1), b = new SeededRandom(9).Fork(2);
        double[] first = Enumerable.Range(0, 100_000).Select(_ => a.NextDouble()).ToArray();
        double[] second = Enumerable.Range(0, 100_000).Select(_ => b.NextDouble()).ToArray();
        Assert.InRange(Correlation.Pearson(first, second), -Bounds.Z / Math.Sqrt(first.Length), Bounds.Z / Math.Sqrt(first.Length));
    }
}
