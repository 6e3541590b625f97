using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Net.Carriers;
using LagSim.Testing.Links;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class PeriodicOutageTests
{
    private static readonly SimDuration Hundredth = SimDuration.FromMilliseconds(10);

    [Fact]
    public void Send_Blackout_LosesEverythingForOneAndAHalfSecondsEveryTwenty()
    {
        bool[] lost = Lost(LinkRun.Of(LinkProfiles.Blackout.ToHost, 1, Hundredth, 100_000));
        (int From, int Length)[] gone = Stretches(lost);
        Assert.InRange(gone.Length, 49, 51);
        Assert.All(gone[1..^1], stretch => Assert.InRange(stretch.Length, 149, 151));
        Assert.All(gone[1..].Zip(gone[2..]), pair => Assert.InRange(pair.Second.From - pair.First.From, 1999, 2001));
    }

    [Fact]
    public void Send_BlackoutWithoutItsOutage_IsSeenToLoseNothing() =>
        Assert.DoesNotContain(true, Lost(LinkRun.Of(new LinkLeg(40, 2), 1, Hundredth, 100_000)));

    [Fact]
    public void Send_Starlink_LosesHalfAfterHalfOfTheHandovers()
    {
        // Ten an outage; where they are is told by a leg that loses nothing but in them, and all of it then.
        const int Datagrams = 600_000;
        SimDuration apart = SimDuration.FromMilliseconds(20);
        PeriodicOutage outage = LinkProfiles.Starlink.ToHost.Outage!;
        bool[] starlink = Lost(LinkRun.Of(LinkProfiles.Starlink.ToHost, 2, apart, Datagrams));
        bool[] every = Lost(LinkRun.Of(With(outage, loss: 100, periods: 100), 2, apart, Datagrams));
        bool[] some = Lost(LinkRun.Of(With(outage, loss: 100, periods: outage.PeriodPercent), 2, apart, Datagrams));

        int handovers = Stretches(every).Length;
        Assert.InRange(handovers, 799, 801);
        Assert.Equal(10, every.Count(lost => lost) / (double)handovers, 0.02);
        Bounds.Near(0.5, Stretches(some).Length / (double)handovers, Bounds.OfShare(0.5, handovers));

        bool[] inOutage = starlink.Where((_, i) => some[i]).ToArray(), outside = starlink.Where((_, i) => !some[i]).ToArray();
        double share = 0.003 + (0.997 * 0.5);
        Bounds.Near(share, inOutage.Count(lost => lost) / (double)inOutage.Length, Bounds.OfShare(share, inOutage.Length));
        Bounds.Near(0.003, outside.Count(lost => lost) / (double)outside.Length, Bounds.OfShare(0.003, outside.Length));
    }

    [Fact]
    public void Send_Starlink_LosesMoreFromTheVeryStepOn()
    {
        LinkLeg leg = new(25) { Step = LinkProfiles.Starlink.ToHost.Step, Outage = new PeriodicOutage(15, 0.2) };
        (SimTime At, LinkDeliveries Arrives)[] run = LinkRun.Of(leg, 3, Hundredth, 100_000);
        foreach ((int from, int length) in Stretches(Lost(run))[1..^1])
        {
            double before = (run[from - 1].Arrives[0] - run[from - 1].At).ToMilliseconds();
            double after = (run[from + length].Arrives[0] - run[from + length].At).ToMilliseconds();
            TestWorlds.Near(10, Math.Abs(after - before), 1e-6);
        }
    }

    [Fact]
    public void Send_WithOrWithoutOutage_WhatArrivesHasTheSameDelay()
    {
        (SimTime At, LinkDeliveries Arrives)[] whole = LinkRun.Of(new LinkLeg(40, 2, 5, 2), 4, SimDuration.FromSeconds(1), 10_000);
        (SimTime At, LinkDeliveries Arrives)[] broken = LinkRun.Of(
            new LinkLeg(40, 2, 5, 2) { Outage = LinkProfiles.Blackout.ToHost.Outage }, 4, SimDuration.FromSeconds(1), 10_000);
        Assert.NotEqual(LinkRun.Fingerprint(whole), LinkRun.Fingerprint(broken));
        Assert.All(whole.Zip(broken), pair => Assert.True(
            pair.Second.Arrives.Count == 0 || (pair.First.Arrives.Count == 1 && pair.First.Arrives[0] == pair.Second.Arrives[0])));
    }

    [Fact]
    public void Send_AfterSilence_IsInTheSameOutagesAsAfterNone()
    {
        LinkLeg leg = With(LinkProfiles.Starlink.ToHost.Outage!, 100, 50);
        bool[] fromTheStart = Lost(LinkRun.Of(leg, 5, Hundredth, 60_000));
        bool[] fromTheMiddle = Lost(LinkRun.Of(new LinkModel(leg, new SeededRandom(5)), SimTime.Zero + (Hundredth * 30_000), Hundredth, 30_000));
        Assert.Equal(fromTheStart[30_000..], fromTheMiddle);
        Assert.Contains(true, fromTheMiddle);
    }

    [Fact]
    public void Network_Blackout_HasItBothWaysAtOnceAndForEachPairByItself()
    {
        VirtualClock clock = new();
        VirtualNetwork network = new(clock, 6, LinkProfiles.Blackout);
        IDatagramPort[] nodes = Enumerable.Range(0, 3).Select(network.CreatePort).ToArray();
        Dictionary<(int From, int To), List<bool>> lost = [];
        for (int i = 0; i < 6000; i++)
        {
            foreach ((int from, int to) in new[] { (0, 1), (1, 0), (0, 2), (2, 0) })
            {
                long before = network.DatagramsLost;
                nodes[from].Send([1], nodes[to].LocalAddress);
                lost.TryAdd((from, to), []);
                lost[(from, to)].Add(network.DatagramsLost > before);
            }

            network.DeliverUntil(clock.Now + Hundredth);
        }

        Assert.InRange(lost[(0, 1)].Count(x => x), 440, 460);
        Assert.Equal(lost[(0, 1)], lost[(1, 0)]);
        Assert.Equal(lost[(0, 2)], lost[(2, 0)]);
        Assert.NotEqual(lost[(0, 1)], lost[(0, 2)]);
    }

    [Theory]
    [InlineData(0, 100, 100, "lengthSeconds")]
    [InlineData(20.1, 100, 100, "lengthSeconds")]
    [InlineData(double.NaN, 100, 100, "lengthSeconds")]
    [InlineData(1, 0, 100, "lossPercent")]
    [InlineData(1, 101, 100, "lossPercent")]
    [InlineData(1, 100, 0, "periodPercent")]
    [InlineData(1, 100, double.NaN, "periodPercent")]
    public void PeriodicOutage_ValueOutOfRange_IsRefused(double length, double loss, double periods, string parameter) =>
        Assert.Equal(parameter, Assert.Throws<ArgumentOutOfRangeException>(() => new PeriodicOutage(20, length, loss, periods)).ParamName);

    private static LinkLeg With(PeriodicOutage like, double loss, double periods) =>
        new(25) { Outage = new PeriodicOutage(like.Period.ToSeconds(), like.Length.ToSeconds(), loss, periods) };

    private static bool[] Lost((SimTime At, LinkDeliveries Arrives)[] run) => Array.ConvertAll(run, sent => sent.Arrives.Count == 0);

    private static (int From, int Length)[] Stretches(bool[] lost)
    {
        List<(int, int)> stretches = [];
        for (int i = 0; i < lost.Length; i++)
        {
            int from = i;
            while (i < lost.Length && lost[i])
            {
                i++;
            }

            if (i > from)
            {
                stretches.Add((from, i - from));
            }
        }

        return [.. stretches];
    }
}
