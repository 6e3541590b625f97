using System;
using System.Linq;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Collisions;
using Xunit;

namespace LagSim.Tests.Numerics;

/// <summary>The first descent of a polynomial gap, against dense sampling with a bound on what rounding can do.</summary>
public sealed class RootIsolationTests
{
    private const int Samples = 2000;

    private delegate double Finder(double[] f, double length);

    private static Config Many => Config.QuickThrowOnFailure.WithMaxTest(1500).WithReplay(20261121, 1);

    /// <summary>Polynomials of every degree: random ones, products with many roots in the interval, and ones that start in an overlap.</summary>
    private static readonly Arbitrary<(double[] F, double Length)> Polynomials = (
        from kind in Gen.Choose(0, 3)
        from degree in Gen.Choose(0, RootIsolation.MaxDegree)
        from draws in Gen.Choose(-1_000_000, 1_000_000).Select(x => x / 1e6).ArrayOf(RootIsolation.MaxDegree + 2)
        from length in Gen.Elements(0.005, 1.0, 1.0, 3.0, 1000.0)
        select (Make(kind, degree, draws, length), length)).ToArbitrary();

    /// <summary>Polynomials whose terms are positive, but for one in half of them.</summary>
    private static readonly Arbitrary<(double[] F, double Length)> MostlyGrowing = (
        from terms in Gen.Choose(2, RootIsolation.MaxDegree + 1)
        from sizes in Gen.Choose(0, 1_000).Select(x => Math.Pow(10, (x / 100.0) - 8)).ArrayOf(terms)
        from isZero in Gen.Choose(0, 4).ArrayOf(terms)
        from down in Gen.Choose(0, (2 * terms) - 1)
        from length in Gen.Elements(0.005, 1.0, 1000.0)
        select (sizes.Select((x, k) => isZero[k] == 0 ? 0 : k == down ? -x : x).ToArray(), length)).ToArbitrary();

    [Fact]
    public void Find_AnyPolynomial_IsTheFirstDescentAndNoOther()
    {
        Check((f, length) => RootIsolation.Find((double[])f.Clone(), length));
    }

    [Fact]
    public void Check_FinderThatOnlySamples_IsSeenToFail()
    {
        Assert.ThrowsAny<Exception>(() => Check((f, length) =>
        {
            for (int i = 0; i <= 50; i++)
            {
                double t = length * i / 50;
                if (Value(f, t) <= 0 && Slope(f, t) < 0)
                {
                    return t;
                }
            }

            return double.NaN;
        }));
    }

    [Fact]
    public void Check_FinderThatMovesTheRootByAMillionth_IsSeenToFail()
    {
        Assert.ThrowsAny<Exception>(() => Check((f, length) => RootIsolation.Find((double[])f.Clone(), length) * (1 + 1e-6)));
    }

    [Fact]
    public void OnlyGrows_AnyPolynomial_HasNoDescentThen()
    {
        // Curved paths are not searched where this says so: it may say so only where the search would find nothing.
        Assert.True(Growing((f, terms) => TimeOfImpact.OnlyGrows(f, terms)) > 100);
        Assert.ThrowsAny<Exception>(() => Growing((f, terms) => TimeOfImpact.OnlyGrows(f, terms - 1))); // the control

        static int Growing(Func<double[], int, bool> onlyGrows)
        {
            int growing = 0;
            Prop.ForAll(MostlyGrowing, p =>
            {
                bool grows = onlyGrows((double[])p.F.Clone(), p.F.Length);
                growing += grows ? 1 : 0;
                return !grows || double.IsNaN(RootIsolation.Find((double[])p.F.Clone(), p.Length));
            }).Check(Many);
            return growing;
        }
    }

    [Fact]
    public void Quadratic_AnyParabola_AgreesWithTheGeneralFinder()
    {
        Prop.ForAll(Polynomials, p =>
        {
            double[] f = [p.F[0], p.F.Length > 1 ? p.F[1] : 0, p.F.Length > 2 ? p.F[2] : 0];
            double closed = Quadratic.FirstDescent(f[0], f[1], f[2]);
            return closed > p.Length || Satisfies(f, p.Length, closed) == "";
        }).Check(Many);
    }

    [Theory]
    [InlineData(1, 0, 0, double.NaN)] // constant
    [InlineData(0, 0, 0, double.NaN)] // always touching
    [InlineData(-1, 0, 0, double.NaN)] // always overlapping, never closing
    [InlineData(1, -2, 0, 0.5)] // linear
    [InlineData(1, 2, 0, double.NaN)]
    [InlineData(1, -2, 1, double.NaN)] // touches at 1 and turns back: a graze
    [InlineData(4, 0, -1, 2)] // falls from its apex
    [InlineData(0, 0, -1, 0)] // touching without speed, pressed
    [InlineData(0, 0, 1, double.NaN)]
    [InlineData(0, 1, -1, 1)] // leaves and returns
    [InlineData(-1, 1, 0, double.NaN)] // overlapping and opening
    [InlineData(-1, -1, 5, 0)] // overlapping and closing
    [InlineData(-1, 1, -1, 0.5)] // opening, never free, closing again from the apex on
    [InlineData(-0.25, 1.25, -1, 1)] // opening, free, back
    public void FirstDescent_CornerCases_AreAsDocumented(double c0, double c1, double c2, double expected)
    {
        Assert.Equal(expected, Quadratic.FirstDescent(c0, c1, c2), 1e-15);
        Assert.Equal(expected, RootIsolation.Find([c0, c1, c2], 10), 1e-15);
        Assert.Equal(expected, RootIsolation.Find([c0, c1, c2, 0, 0, 0, 0, 0, 0, 0, 0], 10), 1e-15);
    }

    [Fact]
    public void Find_ExactDoubleRoot_IsNoEvent()
    {
        Prop.ForAll(Gen.Choose(1, 1023).ToArbitrary(), root =>
        {
            double r = root / 1024.0;
            return double.IsNaN(RootIsolation.Find([r * r, -2 * r, 1], 1)) && double.IsNaN(Quadratic.FirstDescent(r * r, -2 * r, 1));
        }).Check(Many);
    }

    [Fact]
    public void Find_ARealRootNextToTheGraze_IsFound()
    {
        // The negative control of the graze: two roots 2^-20 apart.
        double r = 0.5, s = r + Math.Pow(2, -20);
        Assert.Equal(r, RootIsolation.Find([r * s, -(r + s), 1], 1), 1e-10);
    }

    [Fact]
    public void Find_GrazesOfHighDegree_EndWithoutAFalseDescent()
    {
        // Squares of random quintics: up to five double roots that rounding splits or lifts. It must end, and what it names must be a root.
        Random random = new(5);
        for (int i = 0; i < 3000; i++)
        {
            double[] q = [1];
            for (int k = 0; k < 5; k++)
            {
                q = Times(q, [-random.NextDouble(), 1]);
            }

            double[] f = Times(q, q);
            double root = RootIsolation.Find((double[])f.Clone(), 1);
            Assert.True(double.IsNaN(root) || Value(f, root) <= Bound(f, root));
        }
    }

    private static void Check(Finder find) => Prop.ForAll(Polynomials, p =>
    {
        string reason = Satisfies(p.F, p.Length, find(p.F, p.Length));
        return (reason == "").Label(reason);
    }).Check(Many);

    /// <summary>The definition itself: at the root the gap is closed and falls, and at no earlier sample was it so; both up to rounding.</summary>
    private static string Satisfies(double[] f, double length, double root)
    {
        if (!double.IsNaN(root))
        {
            if (!(root >= 0 && root <= length * (1 + 1e-15)))
            {
                return "outside";
            }

            // Where the slope vanishes a root is only known to the square root of the precision; the value is what counts.
            if (Value(f, root) > Bound(f, root) || Slope(f, root) > SlopeBound(f, root) + Math.Sqrt(Bound(f, root) * Curvature(f, root)))
            {
                return $"no descent at {root:R}: {Value(f, root):R}, slope {Slope(f, root):R}";
            }

            if (f[0] > 0 && -Value(f, root) > Bound(f, root))
            {
                return $"already deep at {root:R}";
            }
        }

        double end = double.IsNaN(root) ? length : root * (1 - 1e-9);
        for (int i = 0; i <= Samples && end > 0; i++)
        {
            double t = end * i / Samples;
            if (Value(f, t) < -Bound(f, t) && Slope(f, t) < -SlopeBound(f, t) - Math.Sqrt(Bound(f, t) * Curvature(f, t)))
            {
                return $"missed a descent at {t:R}, found {root:R}";
            }
        }

        return "";
    }

    private static double[] Make(int kind, int degree, double[] draws, double length)
    {
        if (kind < 2)
        {
            double[] f = draws[..(degree + 1)];
            f[0] = kind == 0 ? Math.Abs(f[0]) : -Math.Abs(f[0]) * 1e-9;
            double scale = 1;
            for (int k = 0; k <= degree; k++, scale /= length)
            {
                f[k] *= scale;
            }

            return f;
        }

        // A product of linear factors, most of its roots inside the interval.
        double[] product = [draws[^1] == 0 ? 1 : Math.Abs(draws[^1])];
        for (int k = 0; k < degree; k++)
        {
            double root = length * (kind == 2 ? Math.Abs(draws[k]) : draws[k]);
            product = Times(product, root > 0 ? [root, -1] : [-root, 1]);
        }

        return product;
    }

    private static double[] Times(double[] a, double[] b)
    {
        double[] product = new double[a.Length + b.Length - 1];
        for (int i = 0; i < a.Length; i++)
        {
            for (int j = 0; j < b.Length; j++)
            {
                product[i + j] += a[i] * b[j];
            }
        }

        return product;
    }

    private static double Value(double[] f, double t) => f.Reverse().Aggregate(0.0, (sum, c) => (sum * t) + c);

    private static double Slope(double[] f, double t) => Value(Derivative(f), t);

    private static double Curvature(double[] f, double t) => 2 * Value(Derivative(Derivative(f)).Select(Math.Abs).ToArray(), t);

    private static double[] Derivative(double[] f) => f.Length == 1 ? [0] : f.Skip(1).Select((c, k) => c * (k + 1)).ToArray();

    /// <summary>What rounding can make of a value near zero: some ulp of the largest thing that was added up, and of a root's place.</summary>
    private static double Bound(double[] f, double t) => 1e-14 * Value(f.Select(Math.Abs).ToArray(), t);

    private static double SlopeBound(double[] f, double t) => 1e-13 * Value(Derivative(f).Select(Math.Abs).ToArray(), t);
}
