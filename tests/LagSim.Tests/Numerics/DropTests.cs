using System;
using System.Linq;
using LagSim.Scenes;
using Xunit;

namespace LagSim.Tests.Numerics;

/// <summary>A dropped ball against the closed form of all its bounces.</summary>
public sealed class DropTests
{
    private const double Height = 1;
    private const double Restitution = 0.8;
    private const int Bounces = 40;

    private static readonly double FirstImpact = Math.Sqrt(2 * Height / TestWorlds.Gravity);

    [Theory]
    [InlineData(MotionLaw.Ballistic, 1e-11)]
    [InlineData(MotionLaw.RungeKutta4, 1e-9)]
    public void Bounces_FirstForty_HappenWhenTheClosedFormSays(MotionLaw flight, double tolerance)
    {
        double[] times = BounceTimes(flight, Restitution);
        Assert.True(times.Length >= Bounces, $"Only {times.Length} bounces.");
        Assert.True(WorstError(times) <= tolerance, $"Off by up to {WorstError(times):R} s.");
    }

    [Fact]
    public void Bounces_RestitutionOffByAMillionth_AreSeenToMiss()
    {
        Assert.True(WorstError(BounceTimes(MotionLaw.Ballistic, Restitution - 1e-6)) > 1e-9);
    }

    [Fact]
    public void Bounces_FirstImpactAtTheNearestMillisecond_AreSeenToMiss()
    {
        double[] snapped = BounceTimes(MotionLaw.RungeKutta4, Restitution).Select(t => Math.Round(t, 3)).ToArray();
        Assert.True(WorstError(snapped) > 1e-9);
    }

    [Theory]
    [InlineData(MotionLaw.Ballistic, 0.8)]
    [InlineData(MotionLaw.Ballistic, 0.5)]
    [InlineData(MotionLaw.Ballistic, 0.99)]
    [InlineData(MotionLaw.RungeKutta4, 0.8)]
    public void Rest_AfterAllBounces_BeginsAtTheirLimit(MotionLaw flight, double e)
    {
        double limit = FirstImpact * (1 + e) / (1 - e);
        Simulation simulation = TestWorlds.Run(TestWorlds.Drop(Height, e, flight), limit + 1);
        var last = simulation.Timeline(TestWorlds.First)[^1];
        Assert.Equal(MotionLaw.Resting, last.State.Motion);
        TestWorlds.Near(limit, last.Key.Time.ToSeconds(), 1e-9);
        Assert.Equal(0.5, last.State.Position.Y);
    }

    private static double[] BounceTimes(MotionLaw flight, double e) =>
        TestWorlds.Impacts(TestWorlds.Run(TestWorlds.Drop(Height, e, flight), 5), TestWorlds.First).Select(i => i.Key.Time.ToSeconds()).ToArray();

    private static double WorstError(double[] times)
    {
        double speed = TestWorlds.Gravity * FirstImpact;
        double worst = 0;
        double power = 1; // e^(n-1)
        for (int n = 1; n <= Bounces; n++)
        {
            double expected = FirstImpact + (2 * speed / TestWorlds.Gravity * Restitution * (1 - power) / (1 - Restitution));
            worst = Math.Max(worst, Math.Abs(times[n - 1] - expected));
            power *= Restitution;
        }

        return worst;
    }
}
