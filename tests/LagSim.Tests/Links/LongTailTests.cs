using System;
using LagSim.Testing.Links;
using LagSim.Time;
using MathNet.Numerics.Distributions;
using MathNet.Numerics.Statistics;
using Xunit;

namespace LagSim.Tests.Links;

public sealed class LongTailTests
{
    private const int Datagrams = 100_000;

    /// <summary>Longer than the longest delay of a hundred thousand, so that none waits for another.</summary>
    private static readonly SimDuration FarApart = SimDuration.FromSeconds(60);

    [Theory]
    [InlineData("wifi-good", 1.5, 0.99, 125)]
    [InlineData("wifi-busy", 10, 0.90, 50)]
    public void Send_DatagramsFarApart_HaveTheMedianAndTheQuantileOfTheDesign(string name, double median, double share, double above)
    {
        double[] delays = Delays(name);
        InQuantiles(delays, 0.5, median, name);
        InQuantiles(delays, share, above, name);
        Assert.InRange(Bounds.KolmogorovDistance(delays, Design(name).CumulativeDistribution), 0, Bounds.KolmogorovLimit(delays.Length));
    }

    [Fact]
    public void KolmogorovDistance_OfTheOtherProfileOrOfPlainJitter_IsSeen()
    {
        double limit = Bounds.KolmogorovLimit(Datagrams);
        Assert.True(Bounds.KolmogorovDistance(Delays("wifi-busy"), Design("wifi-good").CumulativeDistribution) > 10 * limit);
        double[] jitter = LinkRun.Delays(LinkRun.Of(new LinkLeg(10, 30), 1, FarApart, Datagrams));
        Assert.True(Bounds.KolmogorovDistance(jitter, Design("wifi-busy").CumulativeDistribution) > 10 * limit);
    }

    [Fact]
    public void Send_CloseTogether_KeepsTheOrderAndWaitsForTheLate()
    {
        (SimTime At, LinkDeliveries Arrives)[] run = LinkRun.Of(
            new LinkLeg(1.5) { Tail = new LongTail(1, 125) }, 1, SimDuration.FromSeconds(1 / 60.0), Datagrams);
        for (int i = 1; i < run.Length; i++)
        {
            Assert.True(run[i].Arrives[0] >= run[i - 1].Arrives[0]);
        }

        Assert.True(LinkRun.Delays(run).Quantile(0.99) > 125);
    }

    [Fact]
    public void Send_SpreadBeyondAllMeasure_StaysWithinTheLongestDelay()
    {
        LinkLeg leg = new(1e-3) { Tail = new LongTail(49, 1000) };
        double[] delays = LinkRun.Delays(LinkRun.Of(leg, 1, SimDuration.FromSeconds(700), 5000));
        Assert.All(delays, delay => Assert.InRange(delay, 0, LongTail.MaxMilliseconds));
        Assert.Contains(LongTail.MaxMilliseconds, delays);
    }

    [Theory]
    [InlineData(0, 10)]
    [InlineData(50, 10)]
    [InlineData(double.NaN, 10)]
    [InlineData(1, 0)]
    [InlineData(1, double.NaN)]
    [InlineData(1, 600_001)]
    public void LongTail_ValueOutOfRange_IsRefused(double percent, double above) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => new LongTail(percent, above));

    [Fact]
    public void LinkLeg_TailThatContradictsTheLeg_IsRefusedWithBoth()
    {
        LongTail tail = new(1, 125);
        string message = Assert.Throws<ArgumentException>(() => new LinkLeg(1.5, 3) { Tail = tail }).Message;
        Assert.Contains("A leg of 1.5 ms with a jitter of 3 ms cannot have 1 % above 125 ms", message, StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(() => new LinkLeg(0) { Tail = tail });
        Assert.Throws<ArgumentException>(() => new LinkLeg(125) { Tail = tail });
    }

    /// <summary>A measured quantile lies between those of the distribution a little below and a little above.</summary>
    private static void InQuantiles(double[] delays, double share, double expected, string name)
    {
        LogNormal design = Design(name);
        TestWorlds.Near(expected, design.InverseCumulativeDistribution(share), 1e-6 * expected);
        double slack = Bounds.OfShare(share, delays.Length);
        Assert.InRange(
            Statistics.Quantile(delays, share),
            design.InverseCumulativeDistribution(share - slack),
            design.InverseCumulativeDistribution(share + slack));
    }

    private static LogNormal Design(string name) => name == "wifi-good"
        ? new LogNormal(Math.Log(1.5), Math.Log(125 / 1.5) / Normal.InvCDF(0, 1, 0.99))
        : new LogNormal(Math.Log(10), Math.Log(50 / 10.0) / Normal.InvCDF(0, 1, 0.90));

    private static double[] Delays(string name)
    {
        LinkProfiles.TryGet(name, out LinkProfile? profile, out _);
        return LinkRun.Delays(LinkRun.Of(profile!.ToHost, 1, FarApart, Datagrams));
    }
}
