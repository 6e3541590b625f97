using System;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Numerics;

/// <summary>A hundred thousand elastic bounces: what rounding to ticks may and may not do.</summary>
public sealed class ElasticBounceTests
{
    private const int Bounces = 100_000;
    private const double Tick = 1.0 / (1L << 40);

    private static readonly double FirstImpact = Math.Sqrt(2 / TestWorlds.Gravity);

    // What the engine must keep from a height of 1 m, so that the wrong ways below are told apart; from other heights docs/EXACT.md says how much it may be.
    private const double MaxDrift = 5e-14;
    private const double MaxTimeError = 2e-9;

    [Fact]
    public void Bounces_Elastic_KeepEnergyAndTime()
    {
        Simulation simulation = new(TestWorlds.Drop(1, 1));
        SimTime last = TestWorlds.At(((2 * Bounces) - 0.5) * FirstImpact); // half way between two impacts
        for (int part = 1; part <= 100; part++)
        {
            simulation.AdvanceTo(SimTime.FromTicks(last.Ticks / 100 * part));
        }

        simulation.AdvanceTo(last);
        var impacts = TestWorlds.Impacts(simulation, TestWorlds.First);
        Assert.Equal(Bounces, simulation.EventsProcessed);
        Assert.Equal(impacts[^1].Key.Time.ToSeconds(), ((2L * Bounces) - 1) * FirstImpact, MaxTimeError);

        double before = TestWorlds.Gravity * 1.5;
        Assert.True(Math.Abs(TestWorlds.Energy(simulation, last) - before) / TestWorlds.Gravity < MaxDrift);
    }

    /// <summary>
    /// From any height the energy drifts by less than half a rounding of it, 2^-54, a bounce: the least that computing it at each bounce
    /// could do.
    /// </summary>
    [Fact]
    public void Bounces_FromDrawnHeights_DriftByLessThanARoundingEach()
    {
        Random random = new(20_001);
        double worst = 0;
        for (int n = 0; n < 8; n++)
        {
            double height = Math.Pow(10, (2 * random.NextDouble()) - 1);
            Simulation simulation = new(TestWorlds.Drop(height, 1));
            double before = TestWorlds.Energy(simulation, SimTime.FromTicks(0));
            SimTime last = TestWorlds.At(((2 * Bounces) - 0.5) * FirstImpact * Math.Sqrt(height));
            simulation.AdvanceTo(last);
            Assert.InRange(simulation.EventsProcessed, Bounces - 1, Bounces + 1);
            worst = Math.Max(worst, Math.Abs(TestWorlds.Energy(simulation, last) - before) / (TestWorlds.Gravity * height));
        }

        Assert.InRange(worst, MaxDrift, Bounces / Math.Pow(2, 54)); // a single height would not have shown that there is more than from 1 m
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Bounces_ReflectedAtTheTick_AreSeenToDrift(bool snapsGap)
    {
        (double drift, double timeError) = ReflectAtTick(snapsGap);
        Assert.True(timeError > MaxTimeError, $"{timeError:R}");
        Assert.True(!snapsGap || drift > MaxDrift, $"{drift:R}");
    }

    /// <summary>The same bounces as a plain engine with ticks has them: the impact acts at the tick nearest to the root.</summary>
    private static (double Drift, double TimeError) ReflectAtTick(bool snapsGap)
    {
        double gap = 1, v = 0;
        long ticks = 0;
        for (int n = 0; n < Bounces; n++)
        {
            double root = (v + Math.Sqrt((v * v) + (2 * TestWorlds.Gravity * gap))) / TestWorlds.Gravity;
            long whole = (long)Math.Round(root / Tick);
            double t = whole * Tick;
            gap = snapsGap ? 0 : gap + ((v - (0.5 * TestWorlds.Gravity * t)) * t);
            v = (TestWorlds.Gravity * t) - v;
            ticks += whole;
        }

        double energy = (0.5 * v * v) + (TestWorlds.Gravity * gap);
        return (Math.Abs(energy - TestWorlds.Gravity) / TestWorlds.Gravity, Math.Abs((ticks * Tick) - (((2L * Bounces) - 1) * FirstImpact)));
    }
}
