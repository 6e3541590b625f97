using System;
using System.Collections.Generic;
using System.Linq;
using MathNet.Numerics.Distributions;

namespace LagSim.Tests.Links;

/// <summary>How far a measured value may be from the true one: bounds that a right generator misses once in a million seeds.</summary>
internal static class Bounds
{
    internal const double Alpha = 1e-6;

    /// <summary>Two-sided, in standard deviations: 4.89.</summary>
    internal static readonly double Z = Normal.InvCDF(0, 1, 1 - (Alpha / 2));

    /// <summary>Bounds of a measured share of n independent draws.</summary>
    internal static double OfShare(double share, int n) => Z * Math.Sqrt(share * (1 - share) / n);

    internal static void Near(double expected, double actual, double tolerance) =>
        Xunit.Assert.InRange(actual, expected - tolerance, expected + tolerance);

    /// <summary>The largest difference between a sample's distribution and the one it should have.</summary>
    internal static double KolmogorovDistance(IEnumerable<double> sample, Func<double, double> cdf)
    {
        double[] sorted = sample.Order().ToArray();
        return sorted.Select((x, i) => Math.Max(
            Math.Abs(cdf(x) - ((double)i / sorted.Length)), Math.Abs(cdf(x) - ((i + 1.0) / sorted.Length)))).Max();
    }

    internal static double KolmogorovLimit(int n) => Math.Sqrt(-Math.Log(Alpha / 2) / 2 / n);
}
