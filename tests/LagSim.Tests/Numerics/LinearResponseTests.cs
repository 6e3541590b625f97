using System;
using System.Numerics;
using FsCheck;
using FsCheck.Fluent;
using LagSim.Motion;
using Xunit;

namespace LagSim.Tests.Numerics;

/// <summary>The core's own exponentials, sines and cosines, against the platform's.</summary>
public sealed class LinearResponseTests
{
    private const double Ulp = 2.220446049250313e-16;

    [Theory]
    [InlineData(0)]
    [InlineData(1e-9)]
    [InlineData(0.3)]
    [InlineData(1)]
    [InlineData(30)]
    [InlineData(1e6)]
    public void After_DragAlone_IsTheExponential(double rate)
    {
        LinearResponse response = LinearResponse.After(new Rotor(rate, 0), 0, 1);
        Near(Math.Exp(-rate), response.E.Real, 4 + (4 * rate));
        Near(rate < 1e-6 ? 1 - (rate / 2) : (1 - Math.Exp(-rate)) / rate, response.S.Real, 8);
        Assert.Equal(0, response.E.Imaginary);
    }

    [Theory]
    [InlineData(0.1)]
    [InlineData(1)]
    [InlineData(6.3)]
    [InlineData(100)]
    public void After_SpringAlone_IsSineAndCosine(double omega)
    {
        LinearResponse response = LinearResponse.After(default, omega * omega, 1);
        Near(Math.Cos(omega), response.E.Real, 4 + (8 * omega), 1);
        Near(Math.Sin(omega) / omega, response.S.Real, 4 + (8 * omega), 1 / omega);
        Near((1 - Math.Cos(omega)) / (omega * omega), response.Q.Real, 4 + (8 * omega), 1 / (omega * omega));
    }

    /// <summary>Any mixture of drag, spring and turning, for which the roots of s² + lambda s + kappa give the answer where they are not too near to each other.</summary>
    [Fact]
    public void After_AnyMixture_IsWhatTheRootsGive()
    {
        Gen<double> part = Gen.Choose(0, 4000).Select(n => n / 1000.0);
        Gen<(double Gamma, double Omega, double Kappa)> draw = from g in part from o in part from k in part select (g, o - 2, k * k);
        Prop.ForAll(draw.ToArbitrary(), all =>
        {
            Complex lambda = new(all.Gamma, all.Omega);
            Complex root = Complex.Sqrt((lambda * lambda / 4) - all.Kappa);
            if (root.Magnitude < 0.2)
            {
                return; // there the formula below loses more digits than this allows
            }

            Complex first = (-lambda / 2) + root, second = (-lambda / 2) - root;
            Complex s = (Complex.Exp(first) - Complex.Exp(second)) / (first - second);
            Complex e = ((first * Complex.Exp(first)) - (second * Complex.Exp(second))) / (first - second);
            LinearResponse response = LinearResponse.After(new Rotor(all.Gamma, all.Omega), all.Kappa, 1);
            double tolerance = 64 * (1 + lambda.Magnitude + Math.Sqrt(all.Kappa)) / root.Magnitude;
            Near(s, response.S, tolerance);
            Near(e, response.E, tolerance);
        }).QuickCheckThrowOnFailure();
    }

    /// <summary>Twice as far in two steps is as far in one: what lets pieces of a flight be composed.</summary>
    [Fact]
    public void After_TwoSteps_IsOneOfTheirSum()
    {
        LinearResponse one = LinearResponse.After(new Rotor(0.7, 0), 3, 0.4);
        LinearResponse two = LinearResponse.After(new Rotor(0.7, 0), 3, 0.3);
        LinearResponse both = LinearResponse.After(new Rotor(0.7, 0), 3, 0.7);
        double afterOne = one.E.Real + (0.7 * one.S.Real); // what position 1 becomes
        Near(both.S.Real, (one.S.Real * (two.E.Real + (0.7 * two.S.Real))) + (one.E.Real * two.S.Real), 12);
        Near(both.E.Real + (0.7 * both.S.Real), (afterOne * (two.E.Real + (0.7 * two.S.Real))) - (3 * one.S.Real * two.S.Real), 12, 1);
    }

    /// <summary>The control: a series cut at the sixth term is far off, and the tests above see it.</summary>
    [Fact]
    public void Near_OfSixTerms_Fails()
    {
        double cut = 1 - 1 + 0.5 - (1.0 / 6) + (1.0 / 24) - (1.0 / 120);
        Assert.ThrowsAny<Xunit.Sdk.XunitException>(() => Near(Math.Exp(-1), cut, 5));
    }

    private static void Near(double expected, double actual, double ulps, double scale = 0) =>
        TestWorlds.Near(expected, actual, ulps * Ulp * Math.Max(Math.Abs(expected), scale));

    private static void Near(Complex expected, in Rotor actual, double ulps) =>
        Assert.True((expected - new Complex(actual.Real, actual.Imaginary)).Magnitude <= ulps * Ulp * Math.Max(1, expected.Magnitude), $"{expected} {actual.Real:R} {actual.Imaginary:R}");
}
