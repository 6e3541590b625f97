using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Testing.Links;
using LagSim.Time;
using MathNet.Numerics.Distributions;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class LinkModelTests
{
    private const int Datagrams = 100_000;

    /// <summary>Apart far enough that no datagram of a profile here can catch up with another: order costs nothing, every delay is its own.</summary>
    private static readonly SimDuration FarApart = SimDuration.FromSeconds(2);

    [Theory]
    [InlineData("loopback")]
    [InlineData("lan")]
    [InlineData("4g")]
    [InlineData("3g")]
    [InlineData("satellite")]
    [InlineData("awful")]
    public void Send_DatagramsFarApart_DelayIsNormalWithTheProfilesMeanAndDeviation(string name)
    {
        LinkLeg leg = WithoutReordering(Profile(name).ToHost);
        double[] delays = LinkRun.Delays(Run(leg, 1, FarApart));

        double n = delays.Length, sd = leg.JitterMilliseconds;
        Bounds.Near(leg.DelayMilliseconds, delays.Mean(), Bounds.Z * sd / Math.Sqrt(n));
        Bounds.Near(sd, delays.StandardDeviation(), Bounds.Z * sd / Math.Sqrt(2 * n));
        Assert.InRange(
            Bounds.KolmogorovDistance(delays, x => Normal.CDF(leg.DelayMilliseconds, sd, x)), 0, Bounds.KolmogorovLimit(delays.Length));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(25)]
    [InlineData(2000)]
    public void Send_PureDelay_IsExactlyThatLate(double milliseconds)
    {
        SimDuration delay = SimDuration.FromMilliseconds(milliseconds);
        Assert.All(Run(LinkProfiles.PureDelay(milliseconds).ToHost, 3, SimDuration.OneTick), sent =>
        {
            Assert.Equal(1, sent.Arrives.Count);
            Assert.Equal(delay, sent.Arrives[0] - sent.At);
        });
    }

    [Theory]
    [InlineData(10, 5)]
    [InlineData(0.5, 2)]
    [InlineData(1, 1 / 0.99)]
    [InlineData(50, 1)]
    public void Send_LossyLeg_LosesTheShareInBurstsOfTheMeanLength(double percent, double burst)
    {
        bool[] lost = Run(new LinkLeg(1, lossPercent: percent, meanBurstLength: burst), 4, FarApart)
            .Select(sent => sent.Arrives.Count == 0).ToArray();
        List<int> bursts = Bursts(lost);

        // Neighbours share their fate: with correlation c from one to the next the variance of the share is (1 + c) / (1 - c) as large.
        double share = percent / 100, leave = 1 / burst, c = 1 - leave - (leave * share / (1 - share));
        double measured = (double)lost.Count(x => x) / lost.Length;
        Bounds.Near(share, measured, Bounds.OfShare(share, lost.Length) * Math.Sqrt((1 + c) / (1 - c)));

        double burstDeviation = Math.Sqrt(1 - leave) / leave; // of a geometric length
        Bounds.Near(burst, bursts.Average(), (Bounds.Z * burstDeviation / Math.Sqrt(bursts.Count)) + 1e-12);
    }

    [Fact]
    public void Send_AwfulProfile_BurstLengthsAreGeometric()
    {
        List<int> bursts = Bursts(Run(LinkProfiles.Awful.ToHost, 5, FarApart).Select(sent => sent.Arrives.Count == 0).ToArray());

        // Chi-square over lengths 1 to 20, the last being 20 and longer.
        const int Cells = 20;
        double chiSquare = 0;
        for (int length = 1; length <= Cells; length++)
        {
            double expected = bursts.Count * (length < Cells ? 0.2 * Math.Pow(0.8, length - 1) : Math.Pow(0.8, Cells - 1));
            int seen = bursts.Count(burst => length < Cells ? burst == length : burst >= Cells);
            chiSquare += (seen - expected) * (seen - expected) / expected;
        }

        Assert.InRange(chiSquare, 0, ChiSquared.InvCDF(Cells - 1, 1 - Bounds.Alpha));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(100)]
    public void Send_NoLossOrNothingButLoss_IsExactlyThat(double percent)
    {
        Assert.All(Run(new LinkLeg(1, lossPercent: percent), 6, FarApart), sent => Assert.Equal(percent == 0 ? 1 : 0, sent.Arrives.Count));
    }

    [Fact]
    public void Send_AwfulProfile_DuplicatesTheShareOfWhatArrives()
    {
        LinkDeliveries[] arrived = Run(WithoutReordering(LinkProfiles.Awful.ToHost), 7, FarApart)
            .Select(sent => sent.Arrives).Where(arrives => arrives.Count > 0).ToArray();
        Bounds.Near(0.02, (double)arrived.Count(a => a.Count == 2) / arrived.Length, Bounds.OfShare(0.02, arrived.Length));

        // A copy has a delay of its own, raised to the first's where it is the shorter: so half of them are later, and none is earlier.
        LinkDeliveries[] twice = arrived.Where(a => a.Count == 2).ToArray();
        Assert.All(twice, a => Assert.True(a[1] >= a[0]));
        Bounds.Near(0.5, (double)twice.Count(a => a[1] > a[0]) / twice.Length, Bounds.OfShare(0.5, twice.Length));
    }

    [Fact]
    public void Send_CloseTogetherWithReordering_OvertakesExactlyTheShare()
    {
        // Held for 50 to 150 ms where one is sent every 10 ms: whatever is held back is overtaken, and nothing else is.
        LinkLeg leg = new(100, reorderPercent: 5, reorderHoldMilliseconds: 100);
        Assert.InRange(Late(Run(leg, 8, SimDuration.FromMilliseconds(10))), 0.05 - Bounds.OfShare(0.05, Datagrams), 0.05 + Bounds.OfShare(0.05, Datagrams));
    }

    [Fact]
    public void Send_AwfulCloseTogether_OvertakesAboutTheShare()
    {
        // At 60 a second some that are held back are followed by losses only, so a little less than 5 % may show; never more.
        double late = Late(Run(LinkProfiles.Awful.ToHost, 8, SimDuration.FromSeconds(1 / 60.0)));
        Assert.InRange(late, 0.04, 0.05 + Bounds.OfShare(0.05, Datagrams));
    }

    [Fact]
    public void Send_JitterWithoutReordering_KeepsTheOrder()
    {
        Assert.Equal(0, Late(Run(new LinkLeg(200, 60), 9, SimDuration.FromMilliseconds(1))));
    }

    [Fact]
    public void Send_JitterAboveDelay_NeverArrivesBeforeItWasSent()
    {
        (SimTime At, LinkDeliveries Arrives)[] run = Run(new LinkLeg(1, 50, duplicatePercent: 50), 10, FarApart);
        Assert.All(run, sent => Assert.True(sent.Arrives[0] >= sent.At));
        Assert.Contains(run, sent => sent.Arrives[0] == sent.At);
    }

    [Fact]
    public void Send_SameSeed_GivesTheSameBits()
    {
        Assert.Equal(Fingerprint(LinkProfiles.Awful.ToHost, 11), Fingerprint(LinkProfiles.Awful.ToHost, 11));
    }

    [Theory]
    [InlineData("awful", 4486086426672808035UL)]
    [InlineData("wifi-good", 115458257612544808UL)]
    [InlineData("wifi-busy", 7904036080352004899UL)]
    [InlineData("starlink", 13039229625915431900UL)]
    [InlineData("blackout", 2629555760763346737UL)]
    public void Send_ProfileOfEveryKind_GivesThePinnedBits(string name, ulong fingerprint)
    {
        // The same in Debug and Release and on every machine; changes only when what is drawn changes on purpose.
        Assert.Equal(fingerprint, Fingerprint(Profile(name).ToHost, 2026));
    }

    [Fact]
    public void Send_AnotherSeed_GivesOtherBits()
    {
        Assert.NotEqual(Fingerprint(LinkProfiles.Awful.ToHost, 11), Fingerprint(LinkProfiles.Awful.ToHost, 12));
    }

    [Fact]
    public void Send_WithOrWithoutLoss_WhatArrivesHasTheSameDelay()
    {
        (SimTime At, LinkDeliveries Arrives)[] clean = Run(new LinkLeg(200, 20), 13, FarApart);
        (SimTime At, LinkDeliveries Arrives)[] lossy = Run(new LinkLeg(200, 20, lossPercent: 30, meanBurstLength: 3), 13, FarApart);
        Assert.All(clean.Zip(lossy).Where(pair => pair.Second.Arrives.Count > 0), pair =>
            Assert.Equal(pair.First.Arrives[0], pair.Second.Arrives[0]));
    }

    [Fact]
    public void Send_EarlierThanTheLast_IsRefused()
    {
        LinkModel link = new(LinkProfiles.Lan.ToHost, new SeededRandom(1));
        link.Send(SimTime.FromSeconds(2), 1);
        Assert.Throws<ArgumentOutOfRangeException>(() => link.Send(SimTime.FromSeconds(1), 1));
    }

    private static LinkProfile Profile(string name)
    {
        Assert.True(LinkProfiles.TryGet(name, out LinkProfile? profile, out string? error), error);
        return profile;
    }

    private static LinkLeg WithoutReordering(LinkLeg leg) =>
        new(leg.DelayMilliseconds, leg.JitterMilliseconds, leg.LossPercent, leg.MeanBurstLength, 0, leg.DuplicatePercent);

    private static (SimTime At, LinkDeliveries Arrives)[] Run(LinkLeg leg, ulong seed, SimDuration apart) => LinkRun.Of(leg, seed, apart, Datagrams);

    /// <summary>The share of datagrams that arrive after one that was sent later (RFC 4737); copies do not count.</summary>
    private static double Late((SimTime At, LinkDeliveries Arrives)[] run)
    {
        int late = 0;
        SimTime earliestLater = SimTime.MaxValue;
        for (int i = run.Length - 1; i >= 0; i--)
        {
            if (run[i].Arrives.Count > 0)
            {
                late += run[i].Arrives[0] > earliestLater ? 1 : 0;
                earliestLater = SimTime.Min(earliestLater, run[i].Arrives[0]);
            }
        }

        return (double)late / run.Count(sent => sent.Arrives.Count > 0);
    }

    private static List<int> Bursts(bool[] lost)
    {
        List<int> bursts = [];
        for (int i = 0; i < lost.Length; i++)
        {
            if (lost[i] && (i == 0 || !lost[i - 1]))
            {
                bursts.Add(0);
            }

            if (lost[i])
            {
                bursts[^1]++;
            }
        }

        return bursts;
    }

    private static ulong Fingerprint(LinkLeg leg, ulong seed) => LinkRun.Fingerprint(Run(leg, seed, SimDuration.FromMilliseconds(16)));
}
