using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Testing.Links;
using LagSim.Time;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class DelayStepTests
{
    private static readonly SimDuration Second = SimDuration.FromSeconds(1);

    private readonly LinkLeg stepping = new(25) { Step = new DelayStep(periodSeconds: 15, milliseconds: 10) };

    [Fact]
    public void Send_EverySecond_StepsUpAndDownEveryFifteen()
    {
        double[] delays = LinkRun.Delays(LinkRun.Of(stepping, 1, Second, 3000)).Select(delay => Math.Round(delay, 6)).ToArray();
        Assert.Equal([20, 30], delays.Distinct().Order());
        int[] changes = Changes(delays);
        Assert.Equal(199, changes.Length, 1.0);
        Assert.All(changes.Zip(changes.Skip(1)), pair => Assert.Equal(15, pair.Second - pair.First));
    }

    [Fact]
    public void Send_LinkWithoutAStep_IsSeenToHaveNone() => Assert.Empty(Changes(LinkRun.Delays(LinkRun.Of(new LinkLeg(25), 1, Second, 100))));

    [Fact]
    public void Send_Starlink_HasAMeanOfTwentyFiveAndAStepOfTen()
    {
        // Half a second apart no datagram waits for another; which level a time has is told by the same leg without jitter.
        LinkLeg starlink = LinkProfiles.Starlink.ToHost, still = new(25) { Step = starlink.Step };
        (SimTime At, LinkDeliveries Arrives)[] run = LinkRun.Of(starlink, 2, Second / 2, 100_000), level = LinkRun.Of(still, 2, Second / 2, 100_000);
        ILookup<bool, double> delays = run.Zip(level).Where(pair => pair.First.Arrives.Count > 0).ToLookup(
            pair => (pair.Second.Arrives[0] - pair.Second.At).ToMilliseconds() > 25,
            pair => (pair.First.Arrives[0] - pair.First.At).ToMilliseconds());
        double tolerance = Bounds.Z * 7 / Math.Sqrt(delays[true].Count());
        Bounds.Near(30, delays[true].Mean(), tolerance);
        Bounds.Near(20, delays[false].Mean(), tolerance + 0.01); // none is below 0, which lifts the mean by 0.003
        Bounds.Near(7, delays[true].StandardDeviation(), Bounds.Z * 7 / Math.Sqrt(2 * delays[true].Count()));
    }

    [Fact]
    public void Send_WhateverElseIsSent_TheLevelGoesByTheTimeAlone()
    {
        LinkModel busy = new(stepping, new SeededRandom(3)), idle = new(stepping, new SeededRandom(3));
        LinkRun.Of(busy, SimTime.Zero, SimDuration.FromMilliseconds(7), 10_000);
        SimTime later = SimTime.FromSeconds(71.5);
        Assert.Equal(idle.Send(later, LinkRun.DatagramBytes)[0], busy.Send(later, LinkRun.DatagramBytes)[0]);
    }

    [Fact]
    public void Send_TwoDirectionsOfOnePath_StepAtOnceAndOtherPathsDoNot()
    {
        SeededRandom path = new(4);
        double[] up = Delays(new LinkModel(stepping, new SeededRandom(5), path));
        Assert.Equal(up, Delays(new LinkModel(stepping, new SeededRandom(6), path)));

        HashSet<int> first = Enumerable.Range(0, 20).Select(seed => Changes(Delays(new LinkModel(stepping, new SeededRandom((ulong)seed))))[0]).ToHashSet();
        Assert.True(first.Count > 5);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(-1)]
    [InlineData(double.NaN)]
    [InlineData(600_001)]
    public void DelayStep_SizeOutOfRange_IsRefused(double milliseconds) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => new DelayStep(15, milliseconds));

    [Fact]
    public void LinkLeg_StepBelowZero_IsRefused()
    {
        string message = Assert.Throws<ArgumentException>(() => new LinkLeg(4.9) { Step = new DelayStep(15, 10) }).Message;
        Assert.Contains("A delay of 4.9 ms cannot step by 10 ms", message, StringComparison.Ordinal);
    }

    private static double[] Delays(LinkModel link) => LinkRun.Delays(LinkRun.Of(link, SimTime.Zero, Second, 200));

    private static int[] Changes(double[] delays) => Enumerable.Range(1, delays.Length - 1).Where(i => Math.Abs(delays[i] - delays[i - 1]) > 1).ToArray();
}
